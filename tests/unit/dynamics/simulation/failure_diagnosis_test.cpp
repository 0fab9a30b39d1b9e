// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/failure_diagnosis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"
#include "support/point_mass_body.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::failure_diagnosis_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A crank of 0.2 m on a hinge about z.
class OverpoweredJoint : public ::testing::Test {
 protected:
  OverpoweredJoint() {
    SystemBuilder builder;
    const BodyIndex body =
        builder.add_rigid_body("crank", {1.0, 0.01 * Matrix3::Identity()});
    builder.attach_frame("end", body, {});
    builder.add_coupler(
        "hinge",
        joints::make_joint(
            joints::JointKind::revolute, Vector3::UnitZ(), {},
            {.translational_stiffness = 1e6, .rotational_stiffness = 1e3}),
        builder.attach_world("ground", {}),
        builder.attach_frame("pin", body,
                             {Matrix3::Identity(), {-0.2, 0.0, 0.0}}));
    model_ = builder.build();
  }

  // Displaced from the hinge, and turned in it [rad].
  std::string find_cause_at(const Vector3& gap, const Vector3& turn) const {
    SystemState state = make_state(model_);
    state.bodies[0].quat_WB = exp_quaternion(turn);
    state.bodies[0].p_WB = gap + state.bodies[0].quat_WB * Vector3(0.2, 0, 0);
    return find_cause(model_, state, IntegratorKind::generalized_alpha, 1e-4);
  }

  SystemModel model_;
};

TEST_F(OverpoweredJoint, IsNamedWhereItsConstrainedAxesAreTurned) {
  // The chord 2 sin(0.3) of 0.6 rad is more than 0.5.
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.6, 0.0, 0.0}),
              AllOf(HasSubstr("joint 'hinge' deflects by 0.591 rad"),
                    HasSubstr("the loads are stronger than this joint")));
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.4, 0.0, 0.0}), IsEmpty());
}

TEST_F(OverpoweredJoint, IsNamedWhereItsBodiesAreApart) {
  EXPECT_THAT(find_cause_at({0.0, 0.15, 0.0}, Vector3::Zero()),
              AllOf(HasSubstr("joint 'hinge' deflects by 0.15 m"),
                    HasSubstr("the loads are stronger than this joint")));
  EXPECT_THAT(find_cause_at({0.0, 0.05, 0.0}, Vector3::Zero()), IsEmpty());
}

TEST_F(OverpoweredJoint, IsNotOneThatTurnsFreely) {
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.0, 0.0, 2.0}), IsEmpty());
}

// A rigid body, a flexible one whose second mode has 90 rad/s, and a spring.
class MostEnergy : public ::testing::Test {
 protected:
  MostEnergy() {
    SystemBuilder builder;
    const BodyIndex top = builder.add_rigid_body(
        "top", {2.0, Vector3(0.1, 0.2, 0.25).asDiagonal()});
    builder.add_flexible_body(
        "cloud",
        testing::share(testing::make_point_mass_body(24, 2, 4.0, 1.0, 60.0, 3)),
        Fidelity::coupled, {});
    builder.add_coupler("spring",
                        joints::Bushing({.translational_stiffness =
                                             200.0 * Matrix3::Identity()}),
                        builder.attach_world("ground", {}),
                        builder.attach_frame("end", top, {}));
    model_ = builder.build();
    state_ = make_state(model_);
  }
  void move(double translation, double rotation) {  // [J]
    state_.bodies[0].v_WB_W.y() = std::sqrt(2.0 * translation / 2.0);
    state_.bodies[0].w_WB_B.z() = std::sqrt(2.0 * rotation / 0.25);
  }
  [[nodiscard]] std::string find() const {
    return find_most_energy(model_, state_);
  }

  SystemModel model_;
  SystemState state_;
};

TEST_F(MostEnergy, OfABodyIsThatOfTranslationAndRotation) {
  state_.etadot[1] = std::sqrt(2.0 * 0.99);
  move(1.0, 0.0);
  EXPECT_EQ(find(), "the motion of body 'top'");
  move(0.0, 1.0);
  EXPECT_EQ(find(), "the motion of body 'top'");
}

TEST_F(MostEnergy, OfAModeIsThatOfItsDeformationAndVelocity) {
  state_.eta[1] = std::sqrt(2.0 * 0.505) / 90.0;
  state_.etadot[1] = std::sqrt(2.0 * 0.505);
  for (const double fraction : {0.0, 0.5, 1.0}) {
    move(fraction, 1.0 - fraction);
    EXPECT_EQ(find(), "mode 2 (14.32 Hz) of body 'cloud'");
  }
}

// 'cloud' is free: its velocity in the world is nobody's energy.
TEST_F(MostEnergy, LeavesOutTheVelocityOfAFreeMassCentre) {
  state_.bodies[1].v_WB_W.x() = 7500.0;
  move(1.0, 0.0);
  EXPECT_EQ(find(), "the motion of body 'top'");
}

// A damper that takes 100 J in a step of 1 ms, from bodies whose relative
// motion has 0.5 J, is one to name, wherever both go, and whatever passes.
TEST(StartClash, GoesByTheRelativeMotionOfTheBodiesJoined) {
  SystemBuilder builder;
  std::vector<BodyIndex> b;
  for (const char* name : {"a", "b", "stranger"}) {
    b.push_back(builder.add_rigid_body(name, {1.0, Matrix3::Identity()}));
  }
  builder.add_coupler(
      "damper",
      joints::Bushing({.translational_damping = 1e5 * Matrix3::Identity()}),
      builder.attach_frame("on_a", b[0], {}),
      builder.attach_frame("on_b", b[1], {}));
  const SystemModel model = builder.build();
  SystemTerms terms = make_terms(model);
  for (const double common : {0.0, 7500.0}) {
    for (const double passing : {0.0, 5000.0}) {
      SystemState state = make_state(model);
      state.bodies[0].v_WB_W.x() = common;
      state.bodies[1].v_WB_W.x() = common + 1.0;
      state.bodies[2].v_WB_W.x() = passing;
      calc_terms(model, state, Side::right, terms);
      EXPECT_THAT(find_start_clash(model, state, terms, 1e-3),
                  HasSubstr("coupler 'damper' does not allow"));
      EXPECT_THAT(find_start_clash(model, state, terms, 1e-5), IsEmpty());
    }
  }
}

TEST_F(MostEnergy, OfACouplerIsWhatItStores) {
  move(0.0, 1.0);
  state_.bodies[0].p_WB.x() = std::sqrt(1.01 / 100.0);
  EXPECT_EQ(find(), "coupler 'spring'");
}

// Power: force times velocity.
TEST(Driver, IsTheLoadOrDriveOfLargestPowerWithItsController) {
  SystemBuilder builder;
  const limber::testing::Mass mass =
      limber::testing::add_mass(builder, "mass", 2.0);
  const InputIndex push = builder.add_input("push", 3.0);
  const InputIndex pull = builder.add_input("pull", -4.0);
  limber::testing::add_rail(
      builder, mass, "rail",
      {{0, joints::Drive({.mode = joints::DriveMode::effort,
                          .signal = {joints::InputSignal{pull}}})}});
  builder.add_load("push", mass.frame, Vector3::UnitX(), Vector3::Zero(),
                   LoadFrame::world, InputFunction{push, 1.0});
  const auto nothing = std::make_shared<FunctionController>(
      "nothing",
      [](const ControllerView&, std::span<double>, std::span<double>) {});
  builder.add_controller(
      {.name = "thruster", .period = 0.02, .writes = {push}, .law = nothing});
  builder.add_controller(
      {.name = "servo", .period = 0.01, .writes = {pull}, .law = nothing});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  EXPECT_THAT(find_driver(model, state), IsEmpty());
  state.bodies[0].v_WB_W.x() = 2.0;
  EXPECT_EQ(find_driver(model, state),
            "; the largest power is that of the drive of joint 'rail' "
            "(controller 'servo', period 0.01 s): -8 W");
  state.inputs[1].value = -2.0;
  EXPECT_EQ(find_driver(model, state),
            "; the largest power is that of the loads ('push' (controller "
            "'thruster', period 0.02 s)) on body 'mass': 6 W");
}

}  // namespace
}  // namespace limber::dynamics::failure_diagnosis_test
