// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/failure_diagnosis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "limber/common/rotation.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics {
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
  std::string find_cause_at(const Vector3& gap, const Vector3& turn,
                            double supplied = kEnergy) const {
    SystemState state = make_state(model_);
    state.bodies[0].quat_WB = exp_quaternion(turn);
    state.bodies[0].p_WB = gap + state.bodies[0].quat_WB * Vector3(0.2, 0, 0);
    return find_cause(model_, state, IntegratorKind::generalized_alpha, 1e-4,
                      EnergyWatch(supplied, false));
  }

  static constexpr double kEnergy = 1e4;  // about that of the springs [J]
  SystemModel model_;
};

TEST_F(OverpoweredJoint, IsNamedWhereItsConstrainedAxesAreTurned) {
  // The chord 2 sin(0.3) of 0.6 rad is more than 0.5.
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.6, 0.0, 0.0}),
              AllOf(HasSubstr("joint 'hinge' gives way by 0.591 rad"),
                    HasSubstr("the loads are stronger than this joint")));
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.4, 0.0, 0.0}), IsEmpty());
}

TEST_F(OverpoweredJoint, IsNamedWhereItsBodiesAreApart) {
  EXPECT_THAT(find_cause_at({0.0, 0.15, 0.0}, Vector3::Zero()),
              AllOf(HasSubstr("joint 'hinge' gives way by 0.15 m"),
                    HasSubstr("the loads are stronger than this joint")));
  EXPECT_THAT(find_cause_at({0.0, 0.05, 0.0}, Vector3::Zero()), IsEmpty());
}

TEST_F(OverpoweredJoint, IsNotOneThatTurnsFreely) {
  EXPECT_THAT(find_cause_at(Vector3::Zero(), {0.0, 0.0, 2.0}), IsEmpty());
}

TEST_F(OverpoweredJoint, IsNotBlamedWhereTheSchemeBlewUp) {
  // The hinge stores kt d^2 / 2 = 11250 J.
  const Vector3 gap(0.0, 0.15, 0.0);
  EXPECT_THAT(find_cause_at(gap, Vector3::Zero(), 1.0), IsEmpty());
}

}  // namespace
}  // namespace limber::dynamics
