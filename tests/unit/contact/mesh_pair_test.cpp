// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/contact/patches/patch_sides.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/meshes.hpp"
#include "unit/contact/pair_scene.hpp"

/// Rigid meshes that rest, land, strike and fit: against statics, rigid
/// impulses and the conserved quantities.
namespace limber::contact::mesh_pair_test {
namespace {

using Scene = test::PairScene;
using dynamics::IntegratorKind;
using dynamics::kWorld;
using dynamics::SystemBuilder;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81;
constexpr double kModulus = 1e10;  // Young's [Pa]
constexpr double kMass = 2.0;
const Matrix3 kInertia = Vector3(1.2e-3, 1.5e-3, 2.0e-3).asDiagonal();

ContactSide make_side(const TestMesh& mesh) {
  return mesh.make_side(kModulus, kMass, kInertia);
}

// A mesh on something fixed.
Scene make_scene(const ContactSide& fixed, const TestMesh& mesh,
                 const Vector3& gravity, const ContactParameters& parameters) {
  SystemBuilder builder;
  const auto body = builder.add_rigid_body("mesh", {kMass, kInertia});
  ContactSide world = fixed;
  world.mass = kInfinity;
  builder.add_pair(
      "world/mesh", kWorld, body,
      std::make_shared<PatchPair>(world, make_side(mesh), parameters));
  builder.set_gravity(gravity);
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  return scene;
}

ContactSide make_round(const ShapeKind& shape) {
  return {Shape{shape, {}}, SurfaceMaterial{kModulus, 0.3}, kMass, kInertia};
}

Vector3 lean(double slope) {
  return kGravity * Vector3(std::sin(slope), 0.0, -std::cos(slope));
}

ContactSide make_plane() {
  return {Shape{HalfSpace{}, {}}, SurfaceMaterial{kModulus, 0.3}, kInfinity};
}

// Its top at z = 0.
ContactSide make_table() {
  return {Shape{Box{Vector3(0.3, 0.3, 0.1)},
                {Matrix3::Identity(), Vector3(0.0, 0.0, -0.1)}},
          SurfaceMaterial{kModulus, 0.3}, kInfinity};
}

// It lies on its L, of two parts, or stands on a leg.
TEST(MeshPair, HoldsAnAngleOnASlopeWithoutCreep) {
  for (const ContactSide& table : {make_plane(), make_table()}) {
    for (const bool stands : {false, true}) {
      const Matrix3 R =
          exp_rotation(Vector3(stands ? std::numbers::pi / 2 : 0.0, 0, 0));
      Scene scene =
          make_scene(table, make_angle().place({R, Vector3::Zero()}),
                     lean(std::atan(0.3)), {.friction = {.sliding = 0.5}});
      scene.body().p_WB.z() = stands ? 0.04 : 0.03;
      scene.go(0.5, 1e-3);
      const Vector3 early = scene.body().p_WB;
      EXPECT_LT(std::abs(early.x()), 1e-6);
      scene.go(3.0, 1e-3);
      EXPECT_LT((scene.body().p_WB - early).norm(), 1e-11);
      EXPECT_LT(scene.body().quat_WB.vec().norm(), 1e-5);
    }
  }
}

TEST(MeshPair, GainsNoEnergyWhereAMeshFallsAndTopples) {
  for (const TestMesh& mesh :
       {make_angle(), make_rod(20, 0.03, 0.04), make_globe(12, 0.04)}) {
    for (const double e : {1.0, 0.5}) {
      Scene scene =
          make_scene(make_table(), mesh, lean(0.0),
                     {.friction = {.sliding = 0.4}, .restitution = e});
      scene.body().p_WB.z() = 0.1;
      scene.body().quat_WB = Quaternion(exp_rotation(Vector3(0.5, 0.3, 0.2)));
      scene.body().w_WB_B = Vector3(1.0, -2.0, 0.5);
      const auto find_all = [&] {
        return scene.find_energy().total() +
               kMass * kGravity * scene.body().p_WB.z();
      };
      const double before = find_all();
      double highest = before;
      std::size_t touches = 0;
      for (int i = 1; i <= 40; ++i) {
        scene.go(0.02 * i, 1e-3);
        highest = std::max(highest, find_all());
        touches += scene.record.contacts.size();
      }
      EXPECT_GE(touches, 1U);
      EXPECT_LT(highest - before, 1e-6 * kMass * kGravity * 0.1) << e;
      EXPECT_GT(scene.body().p_WB.z(), 0.015);
    }
  }
}

Scene make_strike(const ContactSide& A, const ContactSide& B, double friction,
                  double e, bool is_swapped, const Pose& X = {}) {
  const ContactParameters parameters{.friction = {.sliding = friction},
                                     .restitution = e};
  SystemBuilder builder;
  const auto a = builder.add_rigid_body("a", {kMass, kInertia});
  const auto b = builder.add_rigid_body("b", {kMass, kInertia});
  is_swapped ? builder.add_pair("b/a", b, a,
                                std::make_shared<PatchPair>(B, A, parameters))
             : builder.add_pair("a/b", a, b,
                                std::make_shared<PatchPair>(A, B, parameters));
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  dynamics::BodyState& fixed = scene.state.bodies[0];
  fixed.p_WB = X.p;
  fixed.quat_WB = Quaternion(X.R);
  dynamics::BodyState& flying = scene.state.bodies[1];
  flying.quat_WB =
      Quaternion(Matrix3(X.R * exp_rotation(Vector3(0.6, 0.4, 0.1))));
  flying.p_WB = X * Vector3(0.01, -0.02, 0.12);
  flying.v_WB_W = X.R * Vector3(0.1, 0.05, -0.8);
  flying.w_WB_B = Vector3(0.5, -1.0, 2.0);
  return scene;
}

TEST(MeshPair, KeepsEnergyAndMomentumOfMeshesThatStrike) {
  for (const ContactSide& other :
       {make_side(make_angle()), make_side(make_rod(12, 0.03, 0.04)),
        make_round(Cylinder{0.03, 0.04}), make_round(Capsule{0.02, 0.03}),
        make_round(Sphere{0.04})}) {
    for (const double friction : {0.0, 0.4}) {
      Scene scene =
          make_strike(make_side(make_channel()), other, friction, 1.0, false);
      const double before = scene.find_energy().total();
      scene.go(0.3, 1e-3, IntegratorKind::energy_conserving);
      EXPECT_GE(scene.record.contacts.size(), 1U);
      const double after = scene.find_energy().total();
      if (friction == 0.0) {
        EXPECT_NEAR(after / before, 1.0, 1e-9);
      } else {
        EXPECT_LT(after, before);
      }
      const Vector3 sum =
          scene.state.bodies[0].v_WB_W + scene.state.bodies[1].v_WB_W;
      EXPECT_LT((sum - Vector3(0.1, 0.05, -0.8)).norm(), 1e-9);
    }
  }
}

TEST(MeshPair, DoesNotDependOnNamesPlaceAndAxes) {
  const Pose X{exp_rotation(Vector3(0.3, -1.0, 2.0)), {1e3, -5e2, 2e3}};
  const ContactSide a = make_side(make_channel());
  for (const ContactSide& b :
       {make_side(make_angle()), make_round(Cylinder{0.03, 0.04}),
        make_round(Sphere{0.04})}) {
    Scene one = make_strike(a, b, 0.4, 0.6, false);
    Scene swapped = make_strike(a, b, 0.4, 0.6, true);
    Scene moved = make_strike(a, b, 0.4, 0.6, false, X);
    for (Scene* scene : {&one, &swapped, &moved}) scene->go(0.12, 1e-3);
    EXPECT_GE(one.record.contacts.size(), 1U);
    for (std::size_t i = 0; i < 2; ++i) {
      const Vector3& v = one.state.bodies[i].v_WB_W;
      EXPECT_LT((swapped.state.bodies[i].v_WB_W - v).norm(), 1e-8);
      EXPECT_LT((moved.state.bodies[i].v_WB_W - X.R * v).norm(), 1e-5);
    }
  }
}

// A flat landing.
TEST(MeshPair, PartsAtItsRestitution) {
  for (const double e : {0.9, 0.5}) {
    Scene scene = make_scene(make_plane(), make_rod(16, 0.03, 0.04),
                             Vector3::Zero(), {.restitution = e});
    scene.body().p_WB.z() = 0.0401;
    scene.body().v_WB_W.z() = -0.1;
    scene.go(3e-3, 1e-6);
    EXPECT_NEAR(scene.body().v_WB_W.z() / 0.1, e, 1e-3);
  }
}

// A peg of 24 sides in a hole of 24, 0.1 mm wider, under gravity across it:
// it comes to rest on the hole's lowest facets, and turns no more.
TEST(MeshPair, HoldsAPegInAHole) {
  const TestMesh ring = make_ring(24, 0.0501, 0.08, 0.02);
  ContactSide hole = make_side(ring);
  Scene scene = make_scene(hole, make_rod(24, 0.05, 0.03),
                           kGravity * Vector3(0.0, -1.0, 0.0),
                           {.friction = {.sliding = 0.3}, .restitution = 0.2});
  scene.go(1.0, 1e-3);
  const Vector3 early = scene.body().p_WB;
  EXPECT_LT(early.y(), -5e-5);
  EXPECT_GT(early.y(), -1.2e-4);
  EXPECT_LT(early.head<1>().norm() + std::abs(early.z()), 1e-6);
  scene.go(2.0, 1e-3);
  EXPECT_LT((scene.body().p_WB - early).norm(), 1e-9);
  EXPECT_LT(scene.body().quat_WB.vec().norm(), 1e-3);
}

TEST(MeshPair, HoldsARingOnManyPartsSideBySide) {
  Scene scene = make_scene(make_plane(), make_ring(24, 0.05, 0.08, 0.02),
                           lean(std::atan(0.3)),
                           {.friction = {.sliding = 0.5}, .restitution = 0.5});
  scene.body().p_WB.z() = 0.02;
  scene.go(0.2, 1e-3);
  const Vector3 early = scene.body().p_WB;
  EXPECT_LT(early.z(), 0.02);
  scene.go(0.4, 1e-3);
  EXPECT_LT((scene.body().p_WB - early).norm(), 1e-10);
}

TEST(MeshPair, SuitsMeshesAndFlatSolids) {
  const ContactSide angle = make_side(make_angle());
  EXPECT_TRUE(suits(angle, angle));
  EXPECT_TRUE(suits(make_plane(), angle));
  EXPECT_TRUE(suits(angle, make_table()));
  EXPECT_FALSE(suits(make_side(make_globe(100, 0.1)), angle));
  for (const ShapeKind& shape :
       {ShapeKind(Cylinder{0.03, 0.04}), ShapeKind(Capsule{0.02, 0.03}),
        ShapeKind(Sphere{0.04})}) {
    EXPECT_TRUE(suits(angle, make_round(shape)));
    EXPECT_TRUE(suits(make_round(shape), angle));
    EXPECT_FALSE(suits(make_side(make_globe(40, 0.1)), make_round(shape)));
  }
}

}  // namespace
}  // namespace limber::contact::mesh_pair_test
