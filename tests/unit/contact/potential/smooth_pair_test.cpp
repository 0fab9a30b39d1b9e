// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/smooth_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "unit/contact/potential/patch_differences.hpp"

/// Ellipsoids: Hertz's closed forms, balls as ellipsoids, and their derivatives
/// by differences.
namespace limber::contact::smooth_pair_test {
namespace {

using test::evaluate;
using test::expect_same_patch;

constexpr double kModulus = 1e9;  // [Pa]
constexpr double kPi = std::numbers::pi;
const Ellipsoid kEgg{Vector3(0.02, 0.03, 0.06)};
const Ellipsoid kDisc{Vector3(0.05, 0.04, 0.01)};

Matrix3 turn(double x, double y, double z) {
  return exp_rotation(Vector3(x, y, z));
}

// N of a depth by Hertz's ellipse of half axes a > b of a paraboloid of radii
// R_long > R_across [Johnson 1985, eq. 4.26]: e^2 from their ratio, F =
// (2 pi / 3) a E* d / K.
double find_hertz_load(double R_long, double R_across, double d) {
  double low = 1e-3;
  double high = 1.0 - 1e-12;
  for (int i = 0; i < 80; ++i) {
    const double e = 0.5 * (low + high);
    const double K = std::comp_ellint_1(e);
    const double E = std::comp_ellint_2(e);
    ((E / (1.0 - e * e) - K) / (K - E) < R_long / R_across ? low : high) = e;
  }
  const double K = std::comp_ellint_1(low);
  const double E = std::comp_ellint_2(low);
  const double a = std::sqrt(2.0 * d * R_long * (1.0 - E / K)) / low;
  return 2.0 * kPi / 3.0 * a * kModulus * d / K;
}

PairPotential make_potential(const ShapeKind& A, const ShapeKind& B) {
  return {Shape{A, {}}, Shape{B, {}}, kModulus};
}

TEST(SmoothPair, OfAnEllipsoidOnAPlaneIsHertzs) {
  for (const double ratio : {1.2, 2.0, 5.0, 10.0, 30.0}) {
    // On its pole at z = -c the radii are a^2 / c and b^2 / c.
    const Ellipsoid body{Vector3(0.02 * std::sqrt(ratio), 0.02, 0.03)};
    const double d = 1e-6;
    const Patch patch = evaluate(make_potential(HalfSpace{}, body), {},
                                 {turn(0, 0, 0.4), {0, 0, 0.03 - d}});
    const double R = 0.02 * 0.02 / 0.03;
    EXPECT_NEAR(patch.load() / find_hertz_load(ratio * R, R, d), 1.0, 1e-6)
        << ratio;
    EXPECT_NEAR(patch.energy / (0.4 * patch.load() * d), 1.0, 1e-9);
    EXPECT_NEAR(patch.depth, d, 1e-15);
    EXPECT_LT((patch.centre_W - Vector3(0, 0, -0.5 * d)).norm(), 1e-15);
  }
}

// Each of radii R_1 R_2 / (R_1 + R_2) along its axes.
TEST(SmoothPair, OfTwoEllipsoidsPoleOnPoleIsHertzs) {
  const double d = 1e-6;
  const Patch patch = evaluate(make_potential(kEgg, kDisc), {},
                               {turn(0, 0, 0), {0, 0, 0.07 - d}});
  const auto join = [](double a, double b) { return a * b / (a + b); };
  const double x = join(4e-4 / 0.06, 25e-4 / 0.01);
  const double y = join(9e-4 / 0.06, 16e-4 / 0.01);
  EXPECT_NEAR(patch.load() / find_hertz_load(y, x, d), 1.0, 1e-6);
}

struct Placing {
  std::string name;
  ShapeKind A;
  ShapeKind B;
  Pose X_WB;
};

// B pushed along -way until it overlaps by d.
Placing press(const std::string& name, const ShapeKind& A, const ShapeKind& B,
              const Matrix3& R, const Vector3& way, double d = 2e-5) {
  const PairPotential potential = make_potential(A, B);
  double apart = 1.0;
  double in = 0.0;
  // In steps, so that the first touch counts.
  for (double at = 0.30037; at > 0.0; at -= 1e-3) {
    if (evaluate(potential, {}, {R, at * way}).touches) {
      in = at;
      apart = at + 1e-3;
      break;
    }
  }
  for (int i = 0; i < 60; ++i) {
    const double at = 0.5 * (in + apart);
    const Patch patch = evaluate(potential, {}, {R, at * way});
    (patch.touches && patch.depth > d ? in : apart) = at;
  }
  return {name, A, B, {R, in * way}};
}

std::vector<Placing> make_placings() {
  const Vector3 way = Vector3(0.3, 0.5, 0.8).normalized();
  const Capsule pill{0.02, 0.05};
  const Vector3 up = Vector3::UnitZ();
  const Vector3 side = Vector3(1.0, 0.4, 0.1).normalized();
  return {press("plane", HalfSpace{}, kEgg, turn(0.5, 0.7, 0.2), up),
          press("ball", Sphere{0.03}, kEgg, turn(0.5, 0.7, 0.2), way),
          press("eggs", kEgg, kDisc, turn(0.5, 0.7, 0.2), way),
          press("same eggs", kEgg, kEgg, turn(0.0, 0.0, 0.0), way),
          press("thin eggs", Ellipsoid{Vector3(0.1, 0.01, 0.01)},
                Ellipsoid{Vector3(0.01, 0.2, 0.007)}, turn(0.1, 0.2, 0.4), way),
          press("pill's side", pill, kEgg, turn(0.5, 0.7, 0.2), side),
          press("pill's end", pill, kEgg, turn(0.5, 0.7, 0.2), way),
          press("pill's tip", pill, kDisc, turn(0.1, 0.0, 0.2), up)};
}

TEST(SmoothPair, HasItsDerivativesByDifferences) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing.A, placing.B);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    ASSERT_TRUE(patch.touches);
    const auto energy = [&](const Pose& X) {
      return evaluate(potential, {}, X).energy;
    };
    const Vector6 gradient =
        test::find_gradient(placing.X_WB, patch.centre_W, energy);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(gradient[i], patch.gradient_W[i], 2e-6 * patch.load()) << i;
    }
    const Matrix6 found =
        test::find_hessian(potential, placing.X_WB, patch.centre_W);
    const Matrix6 rest = 0.5 * (found + found.transpose()) - patch.hessian_W;
    EXPECT_LT(rest.topLeftCorner(3, 3).norm(), 1e-5 * patch.hessian_W.norm());
    EXPECT_LT(rest.norm(), 1e-5 * patch.hessian_W.norm()) << rest;
  }
}

TEST(SmoothPair, IsTheSameWithNamesSwappedAndElsewhere) {
  const Pose X{turn(0.3, -1.0, 2.0), {10.0, -20.0, 5.0}};
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing.A, placing.B);
    const Patch one = evaluate(potential, {}, placing.X_WB);
    expect_same_patch(
        one, evaluate(make_potential(placing.B, placing.A), placing.X_WB, {}),
        1e-12, 1e-9);
    const Patch there = evaluate(potential, X, X * placing.X_WB);
    EXPECT_NEAR(there.energy / one.energy, 1.0, 1e-9);
    EXPECT_LT(
        (there.gradient_W.head<3>() - X.R * one.gradient_W.head<3>()).norm(),
        1e-9 * one.load());
  }
}

// A mirror image, x reversed: an ellipsoid is its own.
TEST(SmoothPair, IsMirrored) {
  const Matrix3 M = Vector3(-1.0, 1.0, 1.0).asDiagonal();
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing.A, placing.B);
    const Patch one = evaluate(potential, {}, placing.X_WB);
    const Patch other =
        evaluate(potential, {}, {M * placing.X_WB.R * M, M * placing.X_WB.p});
    EXPECT_NEAR(other.energy / one.energy, 1.0, 1e-9);
    EXPECT_LT(
        (M * other.gradient_W.head<3>() - one.gradient_W.head<3>()).norm(),
        1e-9 * one.load());
  }
}

// On planes, balls, eggs, and on capsules beside, at and beyond their ends.
TEST(SmoothPair, OfABallIsThatOfAnEllipsoidOfEqualRadii) {
  const Sphere ball{0.03};
  const Ellipsoid same{Vector3::Constant(0.03)};
  const Capsule pill{0.02, 0.05};
  std::vector<Placing> placings{
      press("plane", HalfSpace{}, ball, turn(0.5, 0.7, 0.2), Vector3::UnitZ()),
      press("ball", Sphere{0.05}, ball, turn(0.5, 0.7, 0.2),
            Vector3(0.3, 0.5, 0.8).normalized()),
      press("egg", kEgg, ball, turn(0.5, 0.7, 0.2),
            Vector3(0.3, 0.5, 0.8).normalized())};
  for (const double z : {0.0, 0.0497, 0.0499, 0.0501, 0.0503, 0.06, 0.08}) {
    const double x = std::sqrt(std::max(
        std::pow(0.05 - 2e-5, 2) - std::pow(std::max(z - 0.05, 0.0), 2), 0.0));
    placings.push_back(
        {"pill", pill, ball, {turn(0.3, 0.0, 0.5), {x, 0.0, -z}}});
  }
  for (const Placing& placing : placings) {
    SCOPED_TRACE(placing.name);
    const Patch one =
        evaluate(make_potential(placing.A, ball), {}, placing.X_WB);
    const Patch other =
        evaluate(make_potential(placing.A, same), {}, placing.X_WB);
    ASSERT_TRUE(one.touches);
    EXPECT_NEAR(other.energy / one.energy, 1.0, 1e-7);
    EXPECT_LT((other.centre_W - one.centre_W).norm(), 1e-12);
    EXPECT_LT((other.gradient_W - one.gradient_W).norm(), 1e-7 * one.load());
    EXPECT_LT((other.hessian_W - one.hessian_W).norm(),
              1e-6 * one.hessian_W.norm());
    EXPECT_LT((other.spread_W - one.spread_W).norm(),
              1e-6 * one.spread_W.norm());
    EXPECT_LT((other.turns_B_W - one.turns_B_W).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace limber::contact::smooth_pair_test
