// SPDX-License-Identifier: BSD-3-Clause
// Equilibria beside bodies that have nothing to do with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics::equilibrium_groups_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// A hinge about y that a spring of k [N m/rad] turns back.
joints::Joint make_sprung_hinge(double stiffness, double k) {
  joints::ScalarSpring spring(
      {.curve = joints::SpringCurve({.stiffness = k, .extensions = {}}),
       .damping = 0.0});
  return joints::make_joint(joints::JointKind::revolute, -Vector3::UnitY(),
                            Vector3::UnitX(),
                            {.translational_stiffness = stiffness,
                             .rotational_stiffness = stiffness,
                             .translational_damping = 0.0,
                             .rotational_damping = 0.0},
                            {{0, spring}});
}

// Of 20 g on a soft spring, beside a stranger that hangs on one of its own.
double find_angle_beside(double mass, double distance) {
  SystemBuilder builder;
  builder.set_gravity({0, 0, -9.81});
  const BodyIndex bar = builder.add_rigid_body(
      "bar", {0.02, Matrix3(Vector3(1e-3, 7e-3, 7e-3).asDiagonal())});
  builder.add_coupler(
      "hinge", make_sprung_hinge(1e6, 0.4), builder.attach_world("pin", {}),
      builder.attach_frame("end", bar, {Matrix3::Identity(), {-1, 0, 0}}));
  if (mass > 0.0) {
    const BodyIndex stranger =
        builder.add_rigid_body("stranger", {mass, mass * Matrix3::Identity()});
    builder.add_coupler(
        "hold", make_sprung_hinge(1e4 * mass, mass),
        builder.attach_world("place", {Matrix3::Identity(), {distance, 0, 0}}),
        builder.attach_frame("middle", stranger, {}));
  }
  const SystemModel model = builder.build();
  SystemState start = make_state(model);
  start.bodies[0].p_WB = {1, 0, 0};
  if (mass > 0.0) start.bodies[1].p_WB = {distance, 0, 0};
  const Vector3 p = find_equilibrium(model, start).state.bodies[0].p_WB;
  return std::atan2(p.z(), p.x());
}

// Heavy and far away it made the bar's whole motion round-off.
TEST(EquilibriumGroups, DoNotDependOnStrangers) {
  const double alone = find_angle_beside(0.0, 0.0);
  // k angle = -m g l cos(angle)
  EXPECT_NEAR(0.4 * alone, -0.02 * 9.81 * std::cos(alone), 1e-6);
  for (const double mass : {1e-6, 1.0, 1e6}) {
    for (const double distance : {1.0, 1e3, 1e6}) {
      EXPECT_NEAR(find_angle_beside(mass, distance), alone, 1e-9)
          << mass << ' ' << distance;
    }
  }
}

// A stranger's load made the first one's round-off.
TEST(EquilibriumGroups, UnderALoadThatNothingBalancesAreRefused) {
  SystemBuilder builder;
  const BodyIndex free =
      builder.add_rigid_body("free", {1.0, Matrix3::Identity()});
  const BodyIndex held =
      builder.add_rigid_body("held", {1.0, Matrix3::Identity()});
  builder.add_coupler("hinge", make_sprung_hinge(1e8, 1.0),
                      builder.attach_world("pin", {}),
                      builder.attach_frame("at_held", held, {}));
  builder.add_load("weak", builder.attach_frame("at_free", free, {}),
                   {1e-3, 0, 0}, Vector3::Zero(), LoadFrame::world,
                   TimeFunction{});
  builder.add_load("strong", builder.attach_frame("also_at_held", held, {}),
                   {1e8, 0, 0}, Vector3::Zero(), LoadFrame::world,
                   TimeFunction{});
  const SystemModel model = builder.build();
  try {
    static_cast<void>(find_equilibrium(model, make_state(model)));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("body 'free'"),
                                    HasSubstr("net force of 0.001 N")));
  }
}

}  // namespace
}  // namespace limber::dynamics::equilibrium_groups_test
