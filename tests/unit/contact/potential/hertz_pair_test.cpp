// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/hertz_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "unit/contact/potential/patch_differences.hpp"

/// Balls and half spaces against Hertz's closed form and differences.
namespace limber::contact::hertz_pair_test {
namespace {

constexpr double kModulus = 2e9;  // [Pa]

struct Touch {
  Shape A;
  Shape B;
  Pose X_WB;
  double radius;  // R_e [m]
};

// 1e-4 m deep, each body's shape away from its frame and turned.
std::vector<Touch> make_touches() {
  const double d = 1e-4;
  const Pose X_AS{exp_rotation(Vector3(0.4, -0.3, 1.0)), {0.02, 0.01, -0.03}};
  const Pose X_BS{exp_rotation(Vector3(-1.0, 0.3, 0.2)), {-0.01, 0.04, 0.02}};
  const Matrix3 R_WB = exp_rotation(Vector3(0.2, 0.5, -0.7));
  const auto place = [&](const Vector3& centre_W) -> Pose {
    return {R_WB, centre_W - R_WB * X_BS.p};
  };
  const Vector3 way = Vector3(1, -2, 3).normalized();
  const Vector3 up = X_AS.R.col(2);
  const Pose X_B_plane =
      Pose{R_WB, Vector3::Zero()};  // its face has the normal R_WB X_BS z
  const Vector3 down = R_WB * X_BS.R.col(2);
  return {{{Sphere{0.03}, X_AS},
           {Sphere{0.05}, X_BS},
           place(X_AS.p + (0.08 - d) * way),
           0.03 * 0.05 / 0.08},
          {{HalfSpace{}, X_AS},
           {Sphere{0.05}, X_BS},
           place(X_AS.p + (0.05 - d) * up + 0.3 * up.unitOrthogonal()),
           0.05},
          {{Sphere{0.03}, X_AS},
           {HalfSpace{}, X_BS},
           {R_WB, X_AS.p - (0.03 - d) * down - X_B_plane * X_BS.p},
           0.03}};
}

Patch evaluate(const Touch& touch) {
  return test::evaluate({touch.A, touch.B, kModulus}, {}, touch.X_WB);
}

TEST(HertzPair, HasHertzsForceEnergyAndArea) {
  for (const Touch& touch : make_touches()) {
    const Patch patch = evaluate(touch);
    const double d = 1e-4;
    const double force =
        4.0 / 3.0 * kModulus * std::sqrt(touch.radius * d * d * d);
    EXPECT_NEAR(patch.depth, d, 1e-13);
    EXPECT_NEAR(patch.load() / force, 1.0, 1e-9);
    EXPECT_NEAR(patch.energy / (0.4 * force * d), 1.0, 1e-9);
    // int r^2 sqrt(1 - r^2/a^2) over the disc: 2/5 a^2, a^2 = R_e d
    EXPECT_NEAR(patch.spread_W.trace() / (0.4 * touch.radius * d), 1.0, 1e-9);
    EXPECT_NEAR((patch.spread_W * patch.normal_W()).norm(), 0.0, 1e-18);
  }
}

TEST(HertzPair, HasTheGradientAndHessianOfItsEnergy) {
  for (const Touch& touch : make_touches()) {
    const PairPotential potential(touch.A, touch.B, kModulus);
    const Patch patch = evaluate(touch);
    const Vector6 gradient = test::find_gradient(
        touch.X_WB, patch.centre_W,
        [&](const Pose& X) { return test::evaluate(potential, {}, X).energy; });
    EXPECT_LT((gradient - patch.gradient_W).norm(), 1e-6 * patch.load());
    const Matrix6 differences =
        test::find_hessian(potential, touch.X_WB, patch.centre_W);
    const Matrix6 hessian = 0.5 * (differences + differences.transpose());
    const double size = patch.hessian_W.norm();
    EXPECT_LT((hessian - patch.hessian_W).norm(), 1e-6 * size);
    // Turns are weak beside the normal stiffness.
    const double weak = patch.load() * 0.03;
    EXPECT_LT((hessian - patch.hessian_W).bottomRows<3>().norm(),
              1e-3 * weak + 1e-9 * size);
  }
}

TEST(HertzPair, IsTheSameWithNamesSwapped) {
  for (const Touch& touch : make_touches()) {
    const PairPotential swapped(touch.B, touch.A, kModulus);
    test::expect_same_patch(
        evaluate(touch), test::evaluate(swapped, touch.X_WB, {}), 1e-14, 1e-9);
  }
}

TEST(HertzPair, IsNothingApart) {
  for (Touch touch : make_touches()) {
    const Vector3 normal = evaluate(touch).normal_W();
    touch.X_WB.p += 1.01e-4 * normal;
    EXPECT_FALSE(evaluate(touch).touches);
  }
}

}  // namespace
}  // namespace limber::contact::hertz_pair_test
