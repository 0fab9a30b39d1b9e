// SPDX-License-Identifier: BSD-3-Clause
// A singular step reports the cause, not the first body.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "limber/common/errors.hpp"
#include "limber/dynamics/integrators/generalized_alpha.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::dynamics::singular_matrix_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

joints::Joint make_weld() {
  return joints::make_joint(joints::JointKind::fixed, Vector3::UnitX(),
                            Vector3::UnitY(),
                            {.translational_stiffness = 1e6,
                             .rotational_stiffness = 1e6,
                             .translational_damping = 1.0,
                             .rotational_damping = 1.0});
}

// Where the lever of a coupler is beyond all numbers its matrix is, too.
TEST(SingularMatrix, NamesTheCouplerWhereItIs) {
  SystemBuilder builder;
  const auto add = [&](const std::string& name, double x) {
    const auto b = builder.add_rigid_body(name, {1.0, Matrix3::Identity()});
    builder.add_coupler(
        name + "_hold", make_weld(),
        builder.attach_world(name + "_ground",
                             {Matrix3::Identity(), Vector3(x, 0.0, 0.0)}),
        builder.attach_frame(name + "_at", b, {}));
  };
  add("near", 0.0);
  add("far", 0.0);
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[1].p_WB.y() = 1e200;
  GeneralizedAlpha scheme(model, {});
  try {
    scheme.step(state, 1e-3, 1e-3);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("far"), Not(HasSubstr("near"))));
  }
}

}  // namespace
}  // namespace limber::dynamics::singular_matrix_test
