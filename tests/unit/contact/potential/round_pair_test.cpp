// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/round_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/rotation.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "limber/contact/potential/solid_overlap.hpp"
#include "unit/contact/potential/patch_differences.hpp"
#include "unit/contact/potential/round_placings.hpp"

/// Cylinders, cones, capsules, balls and ellipsoids: against closed forms of
/// the overlap, Hertz, the moments of polyhedra, and differences.
namespace limber::contact::round_pair_test {
namespace {

using namespace round_placings;
using test::evaluate;
using test::expect_same_patch;
using test::find_gradient;
using test::find_hessian;
using test::move;

PairPotential make_potential(const Placing& placing) {
  return {Shape{placing.A, {}}, Shape{placing.B, {}}, kModulus};
}

DepthMoments find_moments(const ShapeKind& soft, const ShapeKind& hard,
                          const Pose& X, const Vector3& o) {
  const RuledBody body(make_body(soft));
  const RuledBody other(make_body(hard));
  return SurfaceContact(body, other, X).integrate(o, 1.0, true);
}

// ---- M of one body's depth

TEST(SurfaceContact, OfALyingCylinderIsItsClosedForm) {
  for (const double d : {1e-7, 1e-5}) {
    const double M =
        find_moments(kPlane, kRod, lower(kRod, turn(kPi / 2, 0, 0), d),
                     Vector3::Zero())
            .M;
    const double L = 2.0 * kRod.half_length;
    const double parabola =
        L * std::sqrt(2.0 * kRod.radius) * 256.0 / 315.0 * std::pow(d, 4.5);
    EXPECT_NEAR(M / parabola, 1.0, d / kRod.radius + 1e-7);
  }
}

TEST(SurfaceContact, OfAStandingCylinderIsThatOfAPunch) {
  const double d = 1e-5;
  const double M =
      find_moments(kPlane, kRod, lower(kRod, turn(0, 0, 0), d), Vector3::Zero())
          .M;
  EXPECT_NEAR(M / (kPi * kRod.radius * kRod.radius * std::pow(d, 4)), 1.0,
              1e-9);
}

// Depth u = d - R s a^2 / 2 of the rim's point at the angle a, of slope s; u^5
// / (5 s c) across, R da along: int (1 - x^2)^5 dx = 512 / 693.
TEST(SurfaceContact, OfARimIsItsClosedForm) {
  for (const double tilt : {0.1, 0.3, 0.8}) {
    const double d = 1e-6;
    const double M =
        find_moments(kPlane, kRod, lower(kRod, turn(tilt, 0, 0), d),
                     Vector3::Zero())
            .M;
    const double s = std::sin(tilt);
    const double R = kRod.radius;
    const double closed = R * std::sqrt(2.0 * d / (R * s)) * std::pow(d, 5) *
                          (512.0 / 693.0) / (5.0 * s * std::cos(tilt));
    EXPECT_NEAR(M / closed, 1.0, 1e-3) << tilt;
  }
}

TEST(SurfaceContact, OfABallAndOfACapsuleAreTheirClosedForms) {
  const double d = 1e-6;
  const double ball =
      find_moments(kBall, kPlane, Pose{turn(0, 0, 0), {0, 0, d - kBall.radius}},
                   Vector3::Zero())
          .M;
  EXPECT_NEAR(ball / (0.4 * kPi * kBall.radius * std::pow(d, 5)), 1.0, 1e-4);
  const Pose lying = lower(kPill, turn(kPi / 2, 0, 0), d).inverse();
  const double pill = find_moments(kPill, kPlane, lying, Vector3::Zero()).M;
  const double R = kPill.radius;
  const double line = 2.0 * kPill.half_length * std::sqrt(2.0 * R) * 256.0 /
                      315.0 * std::pow(d, 4.5);
  EXPECT_NEAR(pill / (line + 0.4 * kPi * R * std::pow(d, 5)), 1.0, 1e-4);
}

// By tetrahedra: other code, which has the volume of each cell.
TEST(SurfaceContact, OfBoxesIsThatOfPolyhedra) {
  const double d = 1e-3;
  const std::vector<Matrix3> turns{turn(0, 0, 0.3), turn(1e-2, 2e-2, 0.3),
                                   turn(0.6, 0, 0), turn(0.6, 0.4, 0.2)};
  const Box table{Vector3(0.2, 0.3, 0.1)};
  for (const Matrix3& R : turns) {
    Pose X = lower(kBox, R, d);
    X.p += Vector3(0.18, 0.0, 0.1);
    const ConvexSolid solid(table);
    Polytope overlap;
    find_overlap(solid, {}, ConvexSolid(kBox), X, overlap);
    const DepthMoments found = find_moments(table, kBox, X, Vector3::Zero());
    const DepthMoments other = find_depth_moments(solid, {}, overlap, 0, true);
    EXPECT_NEAR(found.M / other.M, 1.0, 1e-9);
    EXPECT_LT((found.m1 - other.m1).norm(), 1e-9 * other.m1.norm());
    // Of polyhedra, the motion is u + exp(theta).
    const Matrix3 turned = 0.5 * skew(Vector3(other.m1.head<3>()));
    Matrix6 m2 = other.m2;
    m2.topRightCorner<3, 3>() += turned;
    m2.bottomLeftCorner<3, 3>() -= turned;
    EXPECT_LT((found.m2 - m2).norm(), 1e-8 * m2.norm());
  }
}

// The symmetric part: o is fixed.
TEST(SurfaceContact, HasTheHessianOfItsMoment) {
  for (const Placing& placing : make_placings()) {
    if (std::holds_alternative<Sphere>(placing.B) ||
        std::holds_alternative<Ellipsoid>(placing.B) ||
        std::holds_alternative<Capsule>(placing.B)) {
      continue;
    }
    SCOPED_TRACE(placing.name);
    const Vector3 o =
        SurfaceContact(RuledBody(make_body(placing.A)),
                       RuledBody(make_body(placing.B)), placing.X_WB)
            .deepest_place();
    const auto at = [&](const Vector6& by) {
      return find_moments(placing.A, placing.B, move(placing.X_WB, by, o), o);
    };
    const DepthMoments moments = at(Vector6::Zero());
    Matrix6 found;
    for (int i = 0; i < 6; ++i) {
      const test::SmallMotion m(i);
      const auto near = [&](double slope, double expected) {
        const double size = moments.m1.head<3>().norm();
        EXPECT_NEAR(slope, expected, 1e-6 * size) << i;
      };
      near((at(m.by).M - at(-m.by).M) / (2.0 * m.h), moments.m1[i]);
      found.col(i) = (at(m.by).m1 - at(-m.by).m1) / (2.0 * m.h);
    }
    const Matrix6 rest = 0.5 * (found + found.transpose()) - moments.m2;
    EXPECT_LT(rest.norm(), 1e-5 * moments.m2.norm());
  }
}

// ---- W of both

// As in elastic half spaces, of a line of length L and half width b
// [Lundberg and Sjovall 1958]: d = N / (pi E* L) 2 (1.1932 + ln(L / (2 b))).
TEST(RoundPair, OfALyingCylinderIsThatOfALineOfContact) {
  for (const double d : {1e-6, 1e-5, 1e-4}) {
    const Placing placing{"", kPlane, kLog,
                          lower(kLog, turn(kPi / 2, 0, 0), d)};
    const double load =
        evaluate(make_potential(placing), {}, placing.X_WB).load();
    const double L = 2.0 * kLog.half_length;
    const double b = std::sqrt(4.0 * load * kLog.radius / (kPi * kModulus * L));
    const double line =
        2.0 * load / (kPi * kModulus * L) * (1.1932 + std::log(0.5 * L / b));
    EXPECT_NEAR(line / d, 1.0, 0.1) << d;
  }
}

// An ellipse of half axes a > b [Johnson 1985, eq. 4.26]: e^2 from the ratio of
// the curvatures, F = (2 pi / 3) a E* d / K.
TEST(RoundPair, OfCrossedCylindersIsThatOfHertz) {
  const double d = 1e-6;
  const Placing placing{
      "",
      kLog,
      kRod,
      {turn(kPi / 2, 0, 0), {kLog.radius + kRod.radius - d, 0, 0.1}}};
  const double load =
      evaluate(make_potential(placing), {}, placing.X_WB).load();
  const double wanted = kLog.radius / kRod.radius;
  double low = 1e-3;
  double high = 0.999;
  for (int i = 0; i < 60; ++i) {
    const double e = 0.5 * (low + high);
    const double K = std::comp_ellint_1(e);
    const double E = std::comp_ellint_2(e);
    ((E / (1.0 - e * e) - K) / (K - E) < wanted ? low : high) = e;
  }
  const double K = std::comp_ellint_1(low);
  const double E = std::comp_ellint_2(low);
  const double a = std::sqrt(d / K * (K - E) * 2.0 * kLog.radius / (low * low));
  EXPECT_NEAR(load / (2.0 * kPi / 3.0 * a * kModulus * d / K), 1.0, 0.01);
}

TEST(RoundPair, OfABallOnABoxIsThatOfHertz) {
  for (const double d : {1e-7, 1e-6}) {
    const Placing placing{
        "", kBox, kBall, {turn(0, 0, 0), {0.08 - d, 0, 0.01}}};
    const Patch patch = evaluate(make_potential(placing), {}, placing.X_WB);
    const double load =
        4.0 / 3.0 * kModulus * std::sqrt(kBall.radius) * std::pow(d, 1.5);
    EXPECT_NEAR(patch.gradient_W[0] / -load, 1.0, 1e-4);
    EXPECT_NEAR(patch.energy / (0.4 * load * d), 1.0, 1e-4);
    EXPECT_LT((patch.centre_W - Vector3(0.03, 0, 0.01)).norm(), 2.0 * d);
    EXPECT_NEAR(patch.depth / d, 1.0, 1e-6);
  }
}

TEST(RoundPair, OfAStandingCylinderIsThatOfARoundPunch) {
  const double d = 1e-6;
  const Placing placing{"", kPlane, kRod, lower(kRod, turn(0, 0, 0), d)};
  const Patch patch = evaluate(make_potential(placing), {}, placing.X_WB);
  const double k = 2.0 * kModulus * kRod.radius;
  // Next to its rim the nearest face of the cylinder is its side.
  const double rim = 3.0 * d / kRod.radius;
  EXPECT_NEAR(patch.gradient_W[2] / (-k * d), 1.0, rim);
  EXPECT_NEAR(patch.hessian_W(2, 2) / k, 1.0, rim);
  EXPECT_NEAR(patch.spread_W.trace() / (0.5 * kRod.radius * kRod.radius), 1.0,
              rim);
}

// N = 2 E* d^2 / (pi tan b), b the slope of the side to the flat [Johnson 1985,
// sec. 5.2].
TEST(RoundPair, OfATipOnAPlaneIsThatOfACone) {
  for (const Cone& cone : {Cone{0.4, 0.05}, kCone, Cone{0.1, 0.005}}) {
    const double d = 1e-5;
    const Placing placing{"", kPlane, cone, lower(cone, turn(kPi, 0, 0), d)};
    const Patch patch = evaluate(make_potential(placing), {}, placing.X_WB);
    const double slope = 2.0 * cone.half_length / cone.radius;
    const double load = 2.0 / kPi * kModulus * d * d / slope;
    EXPECT_NEAR(patch.load() / load, 1.0, 1e-3) << slope;
    EXPECT_NEAR(patch.energy / (patch.load() * d / 3.0), 1.0, 1e-6);
    EXPECT_LT(patch.gradient_W.head<2>().norm(), 1e-9 * patch.load());
  }
}

TEST(RoundPair, OfAConesDiscIsThatOfARoundPunch) {
  const double d = 1e-6;
  const Placing placing{"", kPlane, kCone, lower(kCone, turn(0, 0, 0), d)};
  const Patch patch = evaluate(make_potential(placing), {}, placing.X_WB);
  const double k = 2.0 * kModulus * kCone.radius;
  EXPECT_NEAR(patch.gradient_W[2] / (-k * d), 1.0, 3.0 * d / kCone.radius);
  EXPECT_NEAR(patch.hessian_W(2, 2) / k, 1.0, 3.0 * d / kCone.radius);
}

// M of a cone by a grid over the overlap with a box that cuts it anywhere.
TEST(SurfaceContact, OfAConeIsTheIntegralOverTheOverlap) {
  const Box table{Vector3(0.1, 0.1, 0.1)};
  const std::vector<Pose> places{
      {turn(0, 0, 0), {0.0, 0.0, 0.12}},        // the tip
      {turn(0.5, 0.3, 0), {0.01, 0.0, 0.125}},  // askew
      {turn(0, 0.5, 0.2), {0.115, 0.01, 0.0}},  // the side
      {turn(0, 0, 0.3), {0.12, 0.0, -0.1}}};    // the rim
  const double slant = std::hypot(0.04, 0.1);
  for (const Pose& X : places) {
    const DepthMoments found = find_moments(kCone, table, X, Vector3::Zero());
    const Pose to_table = X.inverse();
    double sum = 0.0;
    constexpr int kCells = 100;
    const double h = 0.1 / kCells;
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        for (int k = 0; k < kCells; ++k) {
          const Vector3 x((i + 0.5) * h - 0.05, (j + 0.5) * h - 0.05,
                          (k + 0.5) * h - 0.05);
          const double side =
              ((0.05 - x.z()) * 0.04 - x.head<2>().norm() * 0.1) / slant;
          const double t = std::min(side, 0.05 + x.z());
          if (!(t > 0.0)) continue;
          if ((to_table * x).cwiseAbs().maxCoeff() > 0.1) continue;
          sum += 4.0 * t * t * t * h * h * h;
        }
      }
    }
    EXPECT_NEAR(found.M / sum, 1.0, 2e-2);
  }
}

TEST(RoundPair, OfABallIsThatOfAnEllipsoidOfEqualRadii) {
  const Ellipsoid egg{Vector3::Constant(kBall.radius)};
  for (const Placing& placing : make_placings()) {
    if (!std::holds_alternative<Sphere>(placing.B)) continue;
    SCOPED_TRACE(placing.name);
    Placing other = placing;
    other.B = egg;
    const Patch one = evaluate(make_potential(placing), {}, placing.X_WB);
    const Patch same = evaluate(make_potential(other), {}, placing.X_WB);
    EXPECT_NEAR(same.energy / one.energy, 1.0, 1e-8);
    EXPECT_LT((same.gradient_W - one.gradient_W).norm(), 1e-7 * one.load());
    EXPECT_LT((same.hessian_W - one.hessian_W).norm(),
              1e-6 * one.hessian_W.norm());
    EXPECT_NEAR(same.depth / one.depth, 1.0, 1e-4);
  }
}

TEST(RoundPair, PressesACornerOnALongCylinderAtTheCorner) {
  for (const double d : {1e-6, 1e-5, 1e-4}) {
    const Placing placing{"", kLog, kBox, stand_on_log(d)};
    const Patch patch = evaluate(make_potential(placing), {}, placing.X_WB);
    ASSERT_TRUE(patch.touches);
    const Vector3 touch(kLog.radius, 0.0, 0.1);
    EXPECT_LT((patch.centre_W - touch).norm(), 2.0 * d);
    EXPECT_LT(patch.gradient_W.tail<3>().norm(), 2.0 * d * patch.load());
  }
}

TEST(RoundPair, HasTheGradientOfItsEnergy) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    ASSERT_TRUE(patch.touches);
    const auto energy = [&](const Pose& X) {
      return evaluate(potential, {}, X).energy;
    };
    const Vector6 found = find_gradient(placing.X_WB, patch.centre_W, energy);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(found[i], patch.gradient_W[i], placing.slack * patch.load())
          << i;
    }
  }
}

// About the fixed centre; the unsymmetric part is that of axes which move half
// with each body. The second derivative of the factor is not exact.
TEST(RoundPair, HasTheHessianOfItsEnergy) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    const Matrix6 found = find_hessian(potential, placing.X_WB, patch.centre_W);
    const Matrix6& K = patch.hessian_W;
    const Matrix6 rest = 0.5 * (found + found.transpose()) - K;
    const auto size = [](const Matrix6& m, int i, int j) {
      const Matrix3 block = m.block<3, 3>(3 * i, 3 * j);
      return block.norm();
    };
    const double k = size(K, 0, 0);
    const double turned = size(K, 1, 1);
    EXPECT_LT(size(rest, 0, 0), 0.02 * k);
    EXPECT_LT(size(rest, 1, 1), placing.turning * turned + 2e-4 * patch.load());
    EXPECT_LT(size(rest, 0, 1),
              0.02 * std::sqrt(k * turned) + 1e-3 * patch.load());
  }
}

TEST(RoundPair, IsTheSameWithNamesSwapped) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const Patch one = evaluate(make_potential(placing), {}, placing.X_WB);
    const Patch other =
        evaluate({Shape{placing.B, {}}, Shape{placing.A, {}}, kModulus},
                 placing.X_WB, {});
    expect_same_patch(one, other, 1e-9, 1e-6);
  }
}

TEST(RoundPair, IsTheSameElsewhereAndTurned) {
  const Pose X{turn(0.3, -1.0, 2.0), {1e3, -2e3, 5e2}};
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch here = evaluate(potential, {}, placing.X_WB);
    const Patch there = evaluate(potential, X, X * placing.X_WB);
    EXPECT_NEAR(there.energy / here.energy, 1.0, 1e-7);
    EXPECT_LT(
        (there.gradient_W.head<3>() - X.R * here.gradient_W.head<3>()).norm(),
        1e-7 * here.load());
    EXPECT_LT((X.inverse() * there.centre_W - here.centre_W).norm(), 1e-8);
  }
}

ShapeKind scale(const ShapeKind& shape, double s) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) {
    return Sphere{s * ball->radius};
  }
  if (const auto* pill = std::get_if<Capsule>(&shape)) {
    return Capsule{s * pill->radius, s * pill->half_length};
  }
  if (const auto* rod = std::get_if<Cylinder>(&shape)) {
    return Cylinder{s * rod->radius, s * rod->half_length};
  }
  if (const auto* cone = std::get_if<Cone>(&shape)) {
    return Cone{s * cone->radius, s * cone->half_length};
  }
  if (const auto* egg = std::get_if<Ellipsoid>(&shape)) {
    return Ellipsoid{s * egg->radii};
  }
  if (const auto* box = std::get_if<Box>(&shape))
    return Box{s * box->half_size};
  return shape;
}

// W goes with the third power of all lengths.
TEST(RoundPair, DoesNotDependOnTheUnitOfLength) {
  for (const double s : {1e-3, 1e3}) {
    for (const Placing& placing : make_placings()) {
      SCOPED_TRACE(placing.name);
      const Patch one = evaluate(make_potential(placing), {}, placing.X_WB);
      const PairPotential scaled{Shape{scale(placing.A, s), {}},
                                 Shape{scale(placing.B, s), {}}, kModulus};
      const Pose X{placing.X_WB.R, s * placing.X_WB.p};
      const Patch other = evaluate(scaled, {}, X);
      EXPECT_NEAR(other.energy / (s * s * s * one.energy), 1.0, 1e-9);
      EXPECT_NEAR(other.load() / (s * s * one.load()), 1.0, 1e-9);
    }
  }
}

TEST(RoundPair, IsNothingApart) {
  for (const Placing& placing : make_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    Pose X = placing.X_WB;
    X.p += 0.01 * patch.normal_W();
    EXPECT_FALSE(evaluate(potential, {}, X).touches);
  }
}

TEST(RoundPair, LeavesSmoothPairsToHertz) {
  const auto suits = [](const ShapeKind& A, const ShapeKind& B) {
    return RoundPair::suits(make_body(A), make_body(B));
  };
  EXPECT_FALSE(suits(kBall, kPlane));
  EXPECT_FALSE(suits(kBall, kPill));
  EXPECT_FALSE(suits(kPill, kPill));
  EXPECT_FALSE(suits(kBox, kPlane));
  EXPECT_FALSE(suits(kEgg, kPlane));
  EXPECT_FALSE(suits(kEgg, kPill));
  EXPECT_TRUE(suits(kEgg, kBox));
  EXPECT_TRUE(suits(kPill, kPlane));
  EXPECT_TRUE(suits(kBall, kRod));
}

}  // namespace
}  // namespace limber::contact::round_pair_test
