// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/ball_on_capsule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/law/materials.hpp"
#include "limber/contact/potential/hertz_pair.hpp"

/// A ball on a capsule: closed forms, and its derivatives by differences.
namespace limber::contact::ball_on_capsule_test {
namespace {

const double kModulus = 1e9;
const Sphere kBall{0.02};
const Capsule kRod{0.03, 0.1};

Pose at(double x, double z) { return {Matrix3::Identity(), {x, 0.0, z}}; }

Patch press(const Pose& X_rod, const Pose& X_ball) {
  return BallOnCapsule(kRod, kBall, kModulus).evaluate(X_rod, X_ball);
}

// On its side Hertz's ellipse, whose integrals are summed here over 2000
// angles; at the end two balls.
TEST(BallOnCapsule, IsHertzOnItsSideAndItsEnds) {
  const double d = 2e-5;
  const double across = 0.02 * 0.03 / 0.05;
  const double along = 0.02;
  // a / b by its defining ratio, then the depth of load N [johnson1985, 4.2].
  const auto integrals = [](double b) {  // of a = 1: K, E with e^2 = 1 - b^2
    double K = 0.0;
    double E = 0.0;
    const int n = 2000;
    for (int i = 0; i < n; ++i) {
      const double s = std::sin((i + 0.5) * std::acos(0.0) / n);
      const double root = std::sqrt(1.0 - (1.0 - b * b) * s * s);
      K += std::acos(0.0) / n / root;
      E += std::acos(0.0) / n * root;
    }
    return std::pair(K, E);
  };
  double low = 0.1;
  double high = 1.0 - 1e-9;
  for (int i = 0; i < 60; ++i) {
    const double b = 0.5 * (low + high);
    const auto [K, E] = integrals(b);
    const double ratio = (E / (b * b) - K) / (K - E);
    (ratio > along / across ? low : high) = b;
  }
  const double b = 0.5 * (low + high);
  const auto [K, E] = integrals(b);
  // p0 = 3 N / (2 pi a b); d = p0 b K / E*; 1 / (2 R_across) = p0 / (2 E*)
  // (b / a^2 e^2) (a^2 / b^2 E - K), lengths over a.
  const double e2 = 1.0 - b * b;
  const double half = 0.5 / across;
  // p0 / E* = p a with p from the curvature, then a from the depth.
  const double p = half / (b / e2 * (E / (b * b) - K));
  const double a = std::sqrt(d / (p * b * K));
  const double N = 2.0 / 3.0 * std::acos(-1.0) * kModulus * p * a * a * a * b;
  const Patch side = press({}, at(0.05 - d, 0.03));
  EXPECT_NEAR(side.load() / N, 1.0, 1e-6);
  EXPECT_LT((side.normal_W() - Vector3::UnitX()).norm(), 1e-12);

  const Vector3 way = Vector3(0.3, 0.2, 0.7).normalized();
  const Pose end{Matrix3::Identity(),
                 Vector3(0.0, 0.0, 0.1) + (0.05 - d) * way};
  const Patch tip = press({}, end);
  const double k = find_hertz_stiffness(kModulus, across);
  EXPECT_NEAR(tip.load() / (k * d * std::sqrt(d)), 1.0, 1e-12);
}

// The wrench on B, and its derivative, by motions exp(u, theta) of B about the
// place: on the side, at an end, and between them.
TEST(BallOnCapsule, HasItsDerivativesByDifferences) {
  const BallOnCapsule pair(kRod, kBall, kModulus);
  const BallOnCapsule swapped(kBall, kRod, kModulus);
  const Pose X_rod{exp_rotation({0.4, -0.2, 0.9}), {0.3, -0.1, 0.2}};
  for (const double z : {0.0, 0.0997, 0.1003, 0.1007, 0.12}) {
    const double beyond = std::max(z - 0.1, 0.0);
    const double x = std::sqrt(0.0499 * 0.0499 - beyond * beyond);
    const Pose X_ball = X_rod * at(x, z);
    for (const bool is_swapped : {false, true}) {
      const auto evaluate = [&](const Pose& X_B) {
        return is_swapped ? swapped.evaluate(X_ball, X_B)
                          : pair.evaluate(X_rod, X_B);
      };
      const Pose X_B = is_swapped ? X_rod : X_ball;
      const Patch patch = evaluate(X_B);
      const auto move = [&](const Vector6& m) {
        const Matrix3 R = exp_rotation(m.tail<3>());
        const Vector3 r = X_B.p - patch.centre_W;
        const Vector3 u = m.head<3>() + 0.5 * m.tail<3>().cross(m.head<3>());
        return evaluate(Pose{R * X_B.R, Vector3(patch.centre_W + u + R * r)});
      };
      const double h = 1e-7;
      for (int k = 0; k < 6; ++k) {
        const double step = k < 3 ? h : h / 0.02;
        const Vector6 m = step * Vector6::Unit(k);
        const double slope = (move(m).energy - move(-m).energy) / (2.0 * step);
        EXPECT_NEAR(slope / (k < 3 ? 1.0 : 0.02),
                    patch.gradient_W[k] / (k < 3 ? 1.0 : 0.02),
                    1e-5 * patch.load())
            << z << ' ' << k;
        for (int l = 0; l < 6; ++l) {
          const double other = l < 3 ? h : h / 0.02;
          const Vector6 q = other * Vector6::Unit(l);
          const double bend = (move(m + q).energy - move(m - q).energy -
                               move(q - m).energy + move(-m - q).energy) /
                              (4.0 * step * other);
          const double unit = (k < 3 ? 1.0 : 0.02) * (l < 3 ? 1.0 : 0.02);
          const double scale = patch.load() / patch.depth;
          EXPECT_NEAR(bend / unit, patch.hessian_W(k, l) / unit, 2e-3 * scale)
              << z << ' ' << k << ' ' << l;
        }
      }
    }
  }
}

// From the side over an end: the work of the force is what W loses.
TEST(BallOnCapsule, KeepsItsEnergyAroundAnEnd) {
  double work = 0.0;
  const int n = 4000;
  const auto place = [&](int i) {
    const double z = 0.098 + 0.004 * i / n;
    return at(0.0499 + 2e-5 * std::sin(9.0 * i / n), z);
  };
  for (int i = 0; i < n; ++i) {
    const Vector3 way = place(i + 1).p - place(i).p;
    const Pose middle{Matrix3::Identity(), 0.5 * (place(i).p + place(i + 1).p)};
    work += press({}, middle).gradient_W.head<3>().dot(way);
  }
  const double rise = press({}, place(n)).energy - press({}, place(0)).energy;
  EXPECT_NEAR(work, rise, 1e-6 * press({}, place(0)).energy);
}

}  // namespace
}  // namespace limber::contact::ball_on_capsule_test
