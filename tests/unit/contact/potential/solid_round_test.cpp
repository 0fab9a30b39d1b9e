// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "limber/contact/potential/pair_potential.hpp"
#include "limber/contact/potential/surface_moments.hpp"
#include "unit/contact/potential/patch_differences.hpp"
#include "unit/contact/potential/round_placings.hpp"

/// Polyhedra against cylinders, capsules and balls.
namespace limber::contact::solid_round_test {
namespace {

using namespace round_placings;
using test::evaluate;
using test::expect_same_patch;
using test::find_gradient;
using test::find_hessian;
using test::move;

using Face = ConvexSolid::Face;

ConvexSolid bound(const std::vector<Face>& faces, double radius = 0.5) {
  const auto solid =
      ConvexSolid::make_bounded(faces, {Vector3::Zero(), radius});
  EXPECT_TRUE(solid);
  return *solid;
}

Face make_face(const Vector3& n, double h, bool presses = true) {
  return {.plane = {n.normalized(), h}, .presses = presses};
}

// A box as half sizes along x, y, z.
std::vector<Face> list_box(const Vector3& half) {
  std::vector<Face> faces;
  for (int k = 0; k < 3; ++k) {
    faces.push_back(make_face(Vector3::Unit(k), half[k]));
    faces.push_back(make_face(-Vector3::Unit(k), half[k]));
  }
  return faces;
}

// The part of a box on one side of a plane, which does not press.
ConvexSolid cut_box(const Vector3& half, const Vector3& n, double h) {
  std::vector<Face> faces = list_box(half);
  faces.push_back(make_face(n, h, false));
  return bound(faces);
}

// Of `count` sides, |z| <= 0.05.
ConvexSolid make_prism(int count, double radius) {
  std::vector<Face> faces{make_face(Vector3::UnitZ(), 0.05),
                          make_face(-Vector3::UnitZ(), 0.05)};
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * kPi * k / count;
    faces.push_back(make_face({std::cos(angle), std::sin(angle), 0.0}, radius));
  }
  return bound(faces);
}

ConvexSolid make_tetrahedron() {
  return bound({make_face({1, 1, 1}, 0.03), make_face({-1, -1, 1}, 0.03),
                make_face({-1, 1, -1}, 0.03), make_face({1, -1, -1}, 0.03)});
}

struct SolidPlacing {
  std::string name;
  ConvexSolid A;
  ShapeKind B;
  Pose X_WB;
  // Of the gradient, more where the place is cut: the factor leaves out the
  // turn of the resultant.
  double slack = 2e-6;
};

// Of a round shape, from its middle.
Vector3 find_lowest(const ShapeKind& shape, const Matrix3& R) {
  const Vector3 z = Vector3::UnitZ();
  const Vector3 axis = std::copysign(1.0, R(2, 2)) * R.col(2);
  if (const auto* ball = std::get_if<Sphere>(&shape)) return -ball->radius * z;
  if (const auto* pill = std::get_if<Capsule>(&shape)) {
    return -pill->half_length * axis - pill->radius * z;
  }
  const auto& rod = std::get<Cylinder>(shape);
  const Vector3 side = z - axis.z() * axis;
  return -rod.half_length * axis - rod.radius * side.normalized();
}

// The solid at the origin; the lowest point of B d below its highest, at `at`.
Pose rest_on(const ConvexSolid& A, const ShapeKind& B, const Matrix3& R,
             const Vector3& at, double d) {
  const double top = A.find_high(Vector3::UnitZ());
  return {R, Vector3(at.x(), at.y(), top - d) - find_lowest(B, R)};
}

std::vector<SolidPlacing> make_solid_placings() {
  const double d = 1e-4;
  std::vector<SolidPlacing> all;
  const ConvexSolid prism = make_prism(6, 0.04);
  const ConvexSolid slab = cut_box({0.2, 0.2, 0.02}, Vector3(1, 0.3, 0), 0.05);
  const ConvexSolid leaning =
      cut_box({0.2, 0.2, 0.02}, Vector3(1, 0.3, 0.4), 0.05);
  const Matrix3 lying = turn(kPi / 2, 0, 0);
  const Matrix3 askew = turn(kPi / 2 + 1e-3, 2e-3, 0.3);
  const auto add = [&](std::string name, const ConvexSolid& A,
                       const ShapeKind& B, const Matrix3& R,
                       const Vector3& at) {
    const bool is_cut = name.find("cut") != std::string::npos;
    all.push_back(
        {std::move(name), A, B, rest_on(A, B, R, at, d), is_cut ? 1e-5 : 2e-6});
  };
  add("ball on prism's end", prism, kBall, turn(0, 0, 0), {0.01, 0, 0});
  add("pill on prism's end", prism, kPill, askew, {0.01, 0.02, 0});
  add("rod on prism's end", prism, kRod, askew, {0.01, 0.02, 0});
  add("rod stands on prism", prism, kRod, turn(1e-3, 2e-3, 0.3), {0.02, 0, 0});
  add("rod's rim on prism", prism, kRod, turn(0.3, 0.1, 0), {0.0, 0.01, 0});
  add("ball over a cut", slab, kBall, turn(0, 0, 0), {0.053, 0, 0});
  add("pill over a cut", slab, kPill, lying, {0.051, 0, 0});
  add("rod over a cut", slab, kRod, lying, {0.052, 0, 0});
  add("rod's end over a cut", slab, kRod, turn(1e-4, 0, 0), {0.055, 0.01, 0});
  add("rod over a leaning cut", leaning, kRod, lying, {0.046, 0.0, 0});
  // Edges and corners.
  Matrix3 R = turn(0.2, 0.4, 0.1);
  const ConvexSolid tetrahedron = make_tetrahedron();
  const Vector3 corner = tetrahedron.corners().front();
  const Vector3 up = corner.normalized();
  for (const ShapeKind& shape : {ShapeKind(kLog), ShapeKind(kBall)}) {
    const double radius = shape.index() == 0 ? kBall.radius : kLog.radius;
    // Along x of B's frame.
    Matrix3 turned;
    turned.col(0) = up;
    turned.col(1) = up.unitOrthogonal();
    turned.col(2) = up.cross(Vector3(turned.col(1)));
    all.push_back({"corner on round",
                   tetrahedron,
                   shape,
                   {turned, corner + (radius - d) * up +
                                0.1 * Vector3(turned.col(2)) *
                                    (shape.index() == 0 ? 0.0 : 1.0)}});
  }
  // An edge of the prism, along z, at the angle of 30 degrees.
  const double reach = 0.04 / std::cos(kPi / 6);
  const Vector3 out(std::cos(kPi / 6), std::sin(kPi / 6), 0.0);
  Matrix3 across;
  across.col(0) = out;
  across.col(1) = Vector3(0, 0, 1).cross(out);
  across.col(2) = Vector3::UnitZ();
  all.push_back({"edge across log",
                 prism,
                 kLog,
                 {across * turn(1.2, 0, 0), (reach + kLog.radius - d) * out}});
  all.push_back(
      {"edge on ball", prism, kBall, {R, (reach + kBall.radius - d) * out}});
  all.push_back({"edge on pill",
                 prism,
                 kPill,
                 {across * turn(0.7, 0, 0), (reach + kPill.radius - d) * out}});
  return all;
}

PairPotential make_potential(const SolidPlacing& placing) {
  return {PlacedBody{placing.A, {}}, PlacedBody{make_body(placing.B), {}},
          kModulus};
}

TEST(SolidRound, OfABoxByItsFacesIsThatOfTheBox) {
  const ConvexSolid by_faces = bound(list_box(kBox.half_size));
  for (const Placing& placing : make_placings()) {
    const bool is_B = std::holds_alternative<Box>(placing.B);
    const bool is_A = std::holds_alternative<Box>(placing.A);
    if (!is_A && !is_B) continue;
    SCOPED_TRACE(placing.name);
    const PlacedBody box{by_faces, {}};
    const PairPotential potential(
        is_A ? box : PlacedBody{make_body(placing.A), {}},
        is_B ? box : PlacedBody{make_body(placing.B), {}}, kModulus);
    const Patch found = evaluate(potential, {}, placing.X_WB);
    const Patch other =
        evaluate({Shape{placing.A, {}}, Shape{placing.B, {}}, kModulus}, {},
                 placing.X_WB);
    EXPECT_NEAR(found.energy / other.energy, 1.0, 1e-9);
    EXPECT_LT((found.gradient_W - other.gradient_W).norm(),
              1e-9 * other.load());
  }
}

// Its sheets go on between the faces beside the bevels.
TEST(SolidRound, OfABoxWithTinyBevelsIsThatOfTheBox) {
  std::vector<Face> faces = list_box(kBox.half_size);
  const Vector3& half = kBox.half_size;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-1.0, 1.0}) {
      faces.push_back(
          make_face({a, b, 0}, (half.x() + half.y()) / std::sqrt(2.0) - 1e-8));
      faces.push_back(
          make_face({a, 0, b}, (half.x() + half.z()) / std::sqrt(2.0) - 1e-8));
      faces.push_back(
          make_face({0, a, b}, (half.y() + half.z()) / std::sqrt(2.0) - 1e-8));
    }
  }
  const PlacedBody bevelled{bound(faces), {}};
  const PlacedBody log{make_body(kLog), {}};
  for (const Pose& X :
       {stand_on_log(1e-4),
        Pose{turn(0, kPi / 4, 0),
             {kLog.radius + 0.08 / std::sqrt(2.0) - 1e-4, 0, 0.1}}}) {
    const Patch found = evaluate(PairPotential(log, bevelled, kModulus), {}, X);
    const Patch sharp =
        evaluate(PairPotential(log, {make_body(kBox), {}}, kModulus), {}, X);
    EXPECT_NEAR(found.energy / sharp.energy, 1.0, 1e-3);
    EXPECT_NEAR(found.load() / sharp.load(), 1.0, 1e-3);
  }
}

// M of a soft round body is the sum over the parts of a solid.
TEST(SolidRound, HasTheMomentsOfItsPartsTogether) {
  const Box table{Vector3(0.2, 0.2, 0.02)};
  const RuledBody whole(make_body(table));
  for (const Vector3& n : {Vector3(1, 0.3, 0), Vector3(1, -0.2, 0.5)}) {
    const Vector3 unit = n.normalized();
    const RuledBody left(cut_box(table.half_size, unit, 0.05));
    const RuledBody right(cut_box(table.half_size, -unit, -0.05));
    for (const ShapeKind& shape :
         {ShapeKind(kBall), ShapeKind(kPill), ShapeKind(kRod)}) {
      for (const Matrix3& R :
           {turn(kPi / 2 + 1e-3, 2e-3, 0.3), turn(0.3, 0.1, 0)}) {
        const double x = (0.05 - 0.02 * unit.z()) / unit.x();
        const Pose X = rest_on(ConvexSolid(table), shape, R, {x, 0, 0}, 1e-4);
        const Pose X_back = X.inverse();
        const RuledBody round(make_body(shape));
        const auto expect_sum = [&](const auto& integrate) {
          const DepthMoments all = integrate(whole);
          const DepthMoments a = integrate(left);
          const DepthMoments b = integrate(right);
          EXPECT_GT(std::min(a.M, b.M), 1e-3 * all.M);
          EXPECT_NEAR((a.M + b.M) / all.M, 1.0, 1e-6);
          EXPECT_LT((a.m1 + b.m1 - all.m1).norm(), 1e-6 * all.m1.norm());
        };
        SCOPED_TRACE(::testing::Message() << shape.index() << ", " << R(2, 2)
                                          << ", " << n.transpose());
        expect_sum([&](const RuledBody& part) {
          return SurfaceContact(round, part, X_back)
              .integrate(X_back.p, 1.0, false);
        });
      }
    }
  }
}

TEST(SolidRound, HasTheGradientOfItsEnergy) {
  for (const SolidPlacing& placing : make_solid_placings()) {
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

TEST(SolidRound, HasTheHessianOfItsEnergy) {
  for (const SolidPlacing& placing : make_solid_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    const Matrix6 found = find_hessian(potential, placing.X_WB, patch.centre_W);
    const Matrix6 rest = 0.5 * (found + found.transpose()) - patch.hessian_W;
    const auto size = [](const Matrix6& m, int i, int j) {
      const Matrix3 block = m.block<3, 3>(3 * i, 3 * j);
      return block.norm();
    };
    const double k = size(patch.hessian_W, 0, 0);
    const double turned = size(patch.hessian_W, 1, 1);
    EXPECT_LT(size(rest, 0, 0), 0.02 * k);
    EXPECT_LT(size(rest, 1, 1), 0.03 * turned + 2e-4 * patch.load());
  }
}

TEST(SolidRound, IsTheSameWithNamesSwappedAndElsewhere) {
  const Pose X{turn(0.3, -1.0, 2.0), {1e3, -2e3, 5e2}};
  for (const SolidPlacing& placing : make_solid_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch here = evaluate(potential, {}, placing.X_WB);
    expect_same_patch(here,
                      evaluate({PlacedBody{make_body(placing.B), {}},
                                PlacedBody{placing.A, {}}, kModulus},
                               placing.X_WB, {}),
                      1e-9, 1e-6);
    const Patch there = evaluate(potential, X, X * placing.X_WB);
    EXPECT_NEAR(there.energy / here.energy, 1.0, 1e-7);
    EXPECT_LT(
        (there.gradient_W.head<3>() - X.R * here.gradient_W.head<3>()).norm(),
        1e-7 * here.load());
  }
}

TEST(SolidRound, IsNothingApart) {
  for (const SolidPlacing& placing : make_solid_placings()) {
    SCOPED_TRACE(placing.name);
    const PairPotential potential = make_potential(placing);
    const Patch patch = evaluate(potential, {}, placing.X_WB);
    Pose X = placing.X_WB;
    X.p += 0.01 * patch.normal_W();
    EXPECT_FALSE(evaluate(potential, {}, X).touches);
  }
}

}  // namespace
}  // namespace limber::contact::solid_round_test
