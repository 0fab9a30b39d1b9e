// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "limber/common/rotation.hpp"
#include "limber/contact/patches/patch_pair.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "unit/contact/pair_scene.hpp"

/// Cylinders and capsules that rest, roll, topple and strike, in runs.
namespace limber::contact::round_patch_test {
namespace {

using Scene = test::PairScene;
using dynamics::kWorld;
using dynamics::SystemBuilder;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGravity = 9.81;
constexpr double kPi = std::numbers::pi;
constexpr double kMass = 1.0;
const Cylinder kRod{0.02, 0.06};
const SurfaceMaterial kMaterial{1e9, 0.3};

ContactSide make_rod(const ShapeKind& shape = kRod) {
  const double square = kRod.radius * kRod.radius;
  const double across =
      kMass * (square / 4.0 + kRod.half_length * kRod.half_length / 3.0);
  return {Shape{shape, {}}, kMaterial, kMass,
          Vector3(across, across, 0.5 * kMass * square).asDiagonal()};
}

Scene place(const ShapeKind& ground, const Pose& X_WR,
            const ContactParameters& parameters, double slope = 0.0,
            const ShapeKind& rod = kRod) {
  SystemBuilder builder;
  const ContactSide side = make_rod(rod);
  const auto body = builder.add_rigid_body("rod", {kMass, side.inertia_B});
  builder.add_pair("ground/rod", kWorld, body,
                   std::make_shared<PatchPair>(
                       ContactSide{Shape{ground, {}}, kMaterial, kInfinity},
                       side, parameters));
  builder.set_gravity(
      {kGravity * std::sin(slope), 0.0, -kGravity * std::cos(slope)});
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.bodies[0].p_WB = X_WR.p;
  scene.state.bodies[0].quat_WB = Quaternion(X_WR.R);
  return scene;
}

Pose stand(double tilt) {
  return {exp_rotation(Vector3(tilt, 0, 0)),
          Vector3(0, 0,
                  kRod.half_length * std::cos(tilt) +
                      kRod.radius * std::sin(tilt))};
}

const ContactParameters kRough{.friction = {.sliding = 0.5},
                               .restitution = 0.5};

TEST(RoundPatch, RestsStandingAsARoundPunch) {
  for (const ShapeKind& ground :
       {ShapeKind(HalfSpace{}), ShapeKind(Box{Vector3(0.1, 0.1, 0.05)}),
        ShapeKind(Cylinder{0.05, 0.05})}) {
    Pose X = stand(0.0);
    if (!std::holds_alternative<HalfSpace>(ground)) X.p.z() += 0.05;
    Scene scene = place(ground, X, kRough);
    scene.go(0.3, 1e-3);
    const double modulus = 0.5 * kMaterial.youngs_modulus / 0.91;
    const double depth = kMass * kGravity / (2.0 * modulus * kRod.radius);
    EXPECT_NEAR((X.p.z() - scene.body().p_WB.z()) / depth, 1.0, 1e-3);
    EXPECT_LT(scene.body().p_WB.head<2>().norm(), 1e-12);
    EXPECT_LT(scene.body().quat_WB.vec().norm(), 1e-10);
    EXPECT_LT(scene.body().v_WB_W.norm(), 1e-9);
  }
}

TEST(RoundPatch, RestsLying) {
  const Pose X{exp_rotation(Vector3(kPi / 2, 0, 0)), {0, 0, kRod.radius}};
  const Capsule pill{kRod.radius, kRod.half_length};
  for (const ShapeKind& rod : {ShapeKind(kRod), ShapeKind(pill)}) {
    Scene scene = place(HalfSpace{}, X, kRough, 0.0, rod);
    scene.go(0.3, 1e-3);
    const Vector3 early = scene.body().p_WB;
    EXPECT_LT(early.head<2>().norm(), 1e-9);
    EXPECT_LT(scene.body().v_WB_W.norm() + scene.body().w_WB_B.norm(), 1e-9);
    scene.go(0.6, 1e-3);
    EXPECT_LT((scene.body().p_WB - early).norm(), 1e-12);
  }
}

// (2 / 3) g sin, once it lies deep enough to be held; damping does not resist
// it.
TEST(RoundPatch, RollsDownASlopeWithoutSlip) {
  const double slope = 0.2;
  const Pose X{exp_rotation(Vector3(kPi / 2, 0, 0)), {0, 0, kRod.radius}};
  for (const double e : {1.0, 0.5, 0.1}) {
    Scene scene =
        place(HalfSpace{}, X, {.friction = {.sliding = 0.5}, .restitution = e},
              slope);
    scene.go(0.1, 1e-3);
    const double early = scene.body().v_WB_W.x();
    scene.go(0.3, 1e-3);
    const double late = scene.body().v_WB_W.x();
    const double rolling = 2.0 / 3.0 * kGravity * std::sin(slope);
    EXPECT_NEAR((late - early) / 0.2 / rolling, 1.0, 1e-3) << e;
    EXPECT_NEAR(late / (scene.body().w_WB_B.norm() * kRod.radius), 1.0, 1e-3);
    EXPECT_LT(std::abs(scene.body().p_WB.y()), 1e-9);
  }
}

// Its centre of mass is beyond the rim on which it stands: onto its side.
TEST(RoundPatch, TopplesOverItsRimAndGainsNothing) {
  const double tilt = std::atan(kRod.radius / kRod.half_length) + 0.02;
  for (const double e : {0.0, 0.5}) {
    const Pose X = stand(tilt);
    Scene scene =
        place(HalfSpace{}, X, {.friction = {.sliding = 0.5}, .restitution = e});
    const double fall = kMass * kGravity * (X.p.z() - kRod.radius);
    double most = 0.0;
    for (int i = 1; i <= 10; ++i) {
      scene.go(0.1 * i, 1e-3);
      const double energy =
          scene.find_energy().kinetic_rigid +
          kMass * kGravity * (scene.body().p_WB.z() - kRod.radius);
      most = std::max(most, energy / fall);
    }
    EXPECT_LT(most, 1.0 + 1e-3) << e;
    EXPECT_LT(scene.body().p_WB.z(), 1.1 * kRod.radius) << e;
  }
}

const Capsule kPill{kRod.radius, kRod.half_length};

// A capsule's side on a cylinder's rim or on a capsule: both free.
Scene make_strike(bool is_swapped, double e, const ShapeKind& other = kRod) {
  SystemBuilder builder;
  const ContactSide pill = make_rod(kPill);
  const ContactSide rod = make_rod(other);
  const auto first = builder.add_rigid_body("pill", {kMass, pill.inertia_B});
  const auto second = builder.add_rigid_body("rod", {kMass, rod.inertia_B});
  const ContactParameters law{.friction = {.sliding = 0.0}, .restitution = e};
  if (is_swapped) {
    builder.add_pair("rod/pill", second, first,
                     std::make_shared<PatchPair>(rod, pill, law));
  } else {
    builder.add_pair("pill/rod", first, second,
                     std::make_shared<PatchPair>(pill, rod, law));
  }
  Scene scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  auto& A = scene.state.bodies[0];
  A.quat_WB = Quaternion(exp_rotation(Vector3(kPi / 2, 0, 0.3)));
  A.v_WB_W = Vector3(0, 0, 0.5);
  auto& B = scene.state.bodies[1];
  B.quat_WB = Quaternion(exp_rotation(Vector3(0.6, 0.2, 0)));
  B.p_WB = Vector3(0.003, 0.004, 0.1);
  return scene;
}

TEST(RoundPatch, KeepsMomentumAndEnergyOfACapsuleOnARim) {
  for (const double step : {1e-3, 1e-4, 1e-5}) {
    Scene scene = make_strike(false, 1.0);
    const double before = scene.find_energy().kinetic_rigid;
    scene.go(0.2, step);
    const Vector3 momentum =
        kMass * (scene.state.bodies[0].v_WB_W + scene.state.bodies[1].v_WB_W);
    EXPECT_LT((momentum - Vector3(0, 0, 0.5)).norm(), 1e-9);
    EXPECT_GT(scene.state.bodies[1].v_WB_W.z(), 0.05);  // struck
    EXPECT_NEAR(scene.find_energy().kinetic_rigid / before, 1.0, 0.02);
    EXPECT_EQ(scene.statistics.halved_steps, 0);
  }
}

// Side on end, side on side across and along.
TEST(RoundPatch, KeepsMomentumAndEnergyOfTwoCapsules) {
  for (const Vector3& turned : {Vector3(0.6, 0.2, 0), Vector3(0, kPi / 2, 0.1),
                                Vector3(kPi / 2, 0, 0.301)}) {
    Scene scene = make_strike(false, 1.0, kPill);
    scene.state.bodies[1].quat_WB = Quaternion(exp_rotation(turned));
    const double before = scene.find_energy().total();
    scene.go(0.3, 1e-3, dynamics::IntegratorKind::energy_conserving);
    const Vector3 momentum =
        kMass * (scene.state.bodies[0].v_WB_W + scene.state.bodies[1].v_WB_W);
    EXPECT_LT((momentum - Vector3(0, 0, 0.5)).norm(), 1e-9);
    EXPECT_GT(scene.state.bodies[1].v_WB_W.z(), 0.05);  // struck
    EXPECT_NEAR(scene.find_energy().total() / before, 1.0, 1e-9);
    EXPECT_EQ(scene.statistics.halved_steps, 0);
  }
}

TEST(RoundPatch, DoesNotDependOnNames) {
  for (const ShapeKind& shape : {ShapeKind(kRod), ShapeKind(kPill)}) {
    Scene one = make_strike(false, 0.5, shape);
    Scene other = make_strike(true, 0.5, shape);
    one.go(0.2, 1e-4);
    other.go(0.2, 1e-4);
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_LT(
          (one.state.bodies[b].v_WB_W - other.state.bodies[b].v_WB_W).norm(),
          1e-8);
    }
  }
}

}  // namespace
}  // namespace limber::contact::round_patch_test
