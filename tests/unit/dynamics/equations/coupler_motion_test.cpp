// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/coupler_motion.hpp"

#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics::coupler_motion_test {
namespace {

joints::Joint make_hinge() {
  joints::JointParameters held;
  held.translational_stiffness = 300.0;
  held.rotational_stiffness = 20.0;
  joints::ScalarSpring::Parameters spring;
  spring.curve = joints::SpringCurve({.stiffness = 7.0, .extensions = {}});
  joints::Drive::Parameters drive;
  drive.signal.base = joints::ConstantSignal{0.9};
  drive.stiffness = 11.0;
  return joints::make_joint(
      joints::JointKind::revolute, Vector3::UnitZ(), Vector3::UnitX(), held,
      {{0, joints::ScalarSpring(spring)}, {0, joints::Drive(drive)}});
}

SystemModel make_model() {
  SystemBuilder builder;
  const RigidInertia inertia{2.0, Matrix3::Identity()};
  const auto a = builder.add_rigid_body("a", inertia);
  const auto b = builder.add_rigid_body("b", inertia);
  const auto frame_a = builder.attach_frame("a", a, Pose{});
  const auto frame_b = builder.attach_frame("b", b, Pose{});
  const auto world = builder.attach_world("w", Pose{});
  const auto hinge = builder.add_coupler("hinge", make_hinge(), world, frame_a);
  builder.add_coupler(
      "spring", joints::PointSpring({.stiffness = 40.0, .free_length = 1.0}),
      frame_a, frame_b);
  joints::ScalarSpring::Parameters spring;
  spring.curve = joints::SpringCurve({.stiffness = 5.0, .extensions = {}});
  builder.add_path("tendon", {world, frame_a, frame_b},
                   {joints::ScalarSpring(spring)});
  builder.add_joint_sum("gear", {{{hinge, 0, 3.0}}, 0.2},
                        {joints::ScalarSpring(spring)});
  return builder.build();
}

SystemState make_moved(const SystemModel& model) {
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(0.1, 0.2, -0.1);
  state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0.1, -0.1, 0.5)));
  state.bodies[0].w_WB_B = Vector3(0.0, 0.0, 2.0);
  state.bodies[1].p_WB = Vector3(1.0, 2.0, 0.5);
  state.memory[0].near[0] = 12.0;
  return state;
}

TEST(CouplerMotion, EnergiesSumToThoseOfTheBalance) {
  const SystemModel model = make_model();
  const SystemState state = make_moved(model);
  double energy = 0.0;
  for (CouplerIndex c(0); c < std::ssize(model.couplers); ++c) {
    energy += evaluate_coupler(model, state, c).response.energy;
  }
  for (TransmissionIndex t(0); t < std::ssize(model.transmissions); ++t) {
    energy += evaluate_transmission(model, state, t).response.energy;
  }
  EXPECT_GT(energy, 100.0);
  EXPECT_NEAR(energy, calc_energy(model, state).coupler, 1e-12 * energy);
}

// About a hinge's own axis what acts along the coordinate is the moment there.
TEST(CouplerMotion, EffortIsTheMomentAboutTheAxis) {
  const SystemModel model = make_model();
  SystemState state = make_state(model);
  const double z = 0.5 + 4.0 * EIGEN_PI;
  state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0.0, 0.0, 0.5)));
  state.memory[0].near[0] = 12.0;
  const CoordinateReading along =
      evaluate_coordinate(model, state, CouplerIndex(0), 0);
  EXPECT_NEAR(along.motion.z, z, 1e-12);
  EXPECT_NEAR(along.response.force, -7.0 * z - 11.0 * (z - 0.9), 1e-10);
  EXPECT_NEAR(
      evaluate_coupler(model, state, CouplerIndex(0)).response.wrench[5],
      along.response.force, 1e-12 * std::abs(along.response.force));
}

TEST(CouplerMotion, TransmissionsMeasureLengthsAndSumsOfCoordinates) {
  const SystemModel model = make_model();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(3.0, 4.0, 0.0);
  state.bodies[0].v_WB_W = Vector3(0.6, 0.8, 0.0);
  state.bodies[0].quat_WB = Quaternion(exp_rotation(Vector3(0.0, 0.0, 0.5)));
  state.bodies[1].p_WB = Vector3(6.0, 8.0, 0.0);
  const CoordinateReading tendon =
      evaluate_transmission(model, state, TransmissionIndex(0));
  EXPECT_NEAR(tendon.motion.z, 10.0, 1e-12);
  EXPECT_NEAR(tendon.motion.rate, 0.0, 1e-12);  // along a straight line
  EXPECT_NEAR(tendon.response.force, -50.0, 1e-11);
  EXPECT_NEAR(
      evaluate_transmission(model, state, TransmissionIndex(1)).motion.z,
      1.5 - 0.2, 1e-12);
}

}  // namespace
}  // namespace limber::dynamics::coupler_motion_test
