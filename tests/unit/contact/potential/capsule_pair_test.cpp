// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/capsule_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "limber/contact/potential/pair_potential.hpp"
#include "unit/contact/potential/patch_differences.hpp"
#include "unit/contact/potential/round_placings.hpp"

/// Two capsules: against Hertz, lines of contact, and differences.
namespace limber::contact::capsule_pair_test {
namespace {

using namespace round_placings;
using test::evaluate;
using test::expect_same_patch;
using test::find_gradient;
using test::find_hessian;

const Capsule kThin{0.02, 0.1};
const Capsule kThick{0.05, 0.3};

PairPotential make_potential(const Capsule& A, const Capsule& B) {
  return {Shape{A, {}}, Shape{B, {}}, kModulus};
}

// Of an ellipse of contact [Johnson 1985, eq. 4.26]: e^2 from the ratio of the
// radii of curvature R_1 > R_2.
double find_hertz_load(double R1, double R2, double d) {
  if (std::abs(R1 / R2 - 1.0) < 1e-9) {
    return 4.0 / 3.0 * kModulus * std::sqrt(R1) * std::pow(d, 1.5);
  }
  double low = 1e-6;
  double high = 1.0 - 1e-15;
  for (int i = 0; i < 200; ++i) {
    const double e = 0.5 * (low + high);
    const double K = std::comp_ellint_1(e);
    const double E = std::comp_ellint_2(e);
    ((E / (1.0 - e * e) - K) / (K - E) < R1 / R2 ? low : high) = e;
  }
  const double K = std::comp_ellint_1(low);
  const double E = std::comp_ellint_2(low);
  const double a = std::sqrt(d / K * (K - E) * 2.0 * R1 / (low * low));
  return 2.0 * kPi / 3.0 * a * kModulus * d / K;
}

double press(const Capsule& A, const Capsule& B, const Pose& X) {
  return evaluate(make_potential(A, B), {}, X).load();
}

// 1 / R_1 + 1 / R_2 and R_1 R_2 of crossed sides [Johnson 1985, eq. 4.4].
TEST(CapsulePair, OfCrossedSidesIsThatOfHertz) {
  const double Ra = kThick.radius;
  const double Rb = kThin.radius;
  for (const double angle : {0.2, 0.6, kPi / 2}) {
    for (const double d : {1e-6, 1e-5}) {
      const double sum = 0.5 * (1.0 / Ra + 1.0 / Rb);
      const double product =
          0.25 * std::pow(std::sin(angle), 2) / (Ra * Rb);  // of curvatures / 2
      const double root = std::sqrt(sum * sum - 4.0 * product);
      const double wanted =
          find_hertz_load(1.0 / (sum - root), 1.0 / (sum + root), d);
      const Pose X{turn(angle, 0, 0), {Ra + Rb - d, 0, 0.02}};
      EXPECT_NEAR(press(kThick, kThin, X) / wanted, 1.0, 0.01) << angle;
    }
  }
}

TEST(CapsulePair, OfEndsIsThatOfHertz) {
  for (const double d : {1e-6, 1e-5}) {
    const double Ra = kThick.radius;
    const double Rb = kThin.radius;
    const double ends = Ra * Rb / (Ra + Rb);
    const Pose above{
        turn(0, 0, 0),
        {0, 0, kThick.half_length + kThin.half_length + Ra + Rb - d}};
    EXPECT_NEAR(press(kThick, kThin, above) / find_hertz_load(ends, ends, d),
                1.0, 0.01);
    const Pose askew{turn(0.5, 0.3, 0),
                     Vector3(0, 0, kThick.half_length + Ra + Rb - d) +
                         kThin.half_length * turn(0.5, 0.3, 0).col(2)};
    EXPECT_NEAR(press(kThick, kThin, askew) / find_hertz_load(ends, ends, d),
                1.0, 0.01);
    // The end of the thin one on the side of the other.
    const Pose on_side{turn(0, kPi / 2, 0),
                       {Ra + Rb + kThin.half_length - d, 0, 0.02}};
    EXPECT_NEAR(press(kThick, kThin, on_side) / find_hertz_load(Rb, ends, d),
                1.0, 0.01);
  }
}

// As in elastic half spaces, of a line of length L and half width b
// [Lundberg and Sjovall 1958]: d = N / (pi E* L) 2 (1.1932 + ln(L / (2 b))).
TEST(CapsulePair, OfParallelSidesIsThatOfALineOfContact) {
  const double radius =
      kThick.radius * kThin.radius / (kThick.radius + kThin.radius);
  for (const double d : {1e-6, 1e-5, 1e-4}) {
    const Pose X{turn(0, 0, 0), {kThick.radius + kThin.radius - d, 0, 0.02}};
    const double load = press(kThick, kThin, X);
    const double L = 2.0 * kThin.half_length;
    const double b = std::sqrt(4.0 * load * radius / (kPi * kModulus * L));
    const double line =
        2.0 * load / (kPi * kModulus * L) * (1.1932 + std::log(0.5 * L / b));
    EXPECT_NEAR(line / d, 1.0, 0.12) << d;
  }
}

std::vector<Pose> list_poses() {
  const double reach = kThick.radius + kThin.radius - 1e-4;
  const double L = kThin.half_length;
  const Matrix3 R = turn(0, 1.0, 0);
  return {{turn(kPi / 2, 0, 0), {reach, 0, 0.1}},
          {turn(0.2, 0, 0), {reach, 0, 0.1}},
          {turn(0.01, 0.001, 0), {reach, 0, 0.1}},
          {turn(0, 0, 0), {reach, 0, 0.1}},
          {turn(0, 1e-3, 0), {reach, 0, 0.1}},
          {turn(0, 0.03, 0), {reach + 0.03 * L, 0, 0.1}},
          {turn(0, 0.08, 0), {reach + 0.08 * L, 0, 0.1}},
          {turn(0, 1e-3, 0), {reach, 0, 0.36}},
          {turn(0.001, 0, 0), {reach, 0, 0.4}},
          {R, Vector3(reach, 0, 0.1) + L * R.col(2)},
          {R, Vector3(0, 0, kThick.half_length + reach) + L * R.col(2)},
          {turn(0.4, 0, 0), {reach, 0, 0.3}}};
}

// To 1e-6 of the load of sides, 1.1e-5 where a tilted side passes into its end.
TEST(CapsulePair, HasTheGradientOfItsEnergy) {
  int number = 0;
  for (const Pose& X : list_poses()) {
    SCOPED_TRACE(number++);
    const PairPotential potential = make_potential(kThick, kThin);
    const Patch patch = evaluate(potential, {}, X);
    ASSERT_TRUE(patch.touches);
    const auto energy = [&](const Pose& at) {
      return evaluate(potential, {}, at).energy;
    };
    const Vector6 found = find_gradient(X, patch.centre_W, energy);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(found[i], patch.gradient_W[i], 2e-5 * patch.load()) << i;
    }
    const Matrix6 hessian = find_hessian(potential, X, patch.centre_W);
    const Matrix6 rest =
        0.5 * (hessian + hessian.transpose()) - patch.hessian_W;
    EXPECT_LT(rest.norm(), 1e-3 * patch.hessian_W.norm());
    const Patch swapped = evaluate(make_potential(kThin, kThick), X, {});
    expect_same_patch(patch, swapped, 1e-12, 1e-5);
  }
}

}  // namespace
}  // namespace limber::contact::capsule_pair_test
