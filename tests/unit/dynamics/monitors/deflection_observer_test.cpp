// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/deflection_observer.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "support/chain.hpp"
#include "support/point_mass_body.hpp"

namespace limber::dynamics::deflection_observer_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kStiffness = 1e4;    ///< [N/m]
constexpr double kDeflection = 1e-4;  ///< [m]

/// A body with a loss factor on a joint that is displaced by kDeflection.
class DampedBody : public ::testing::Test {
 protected:
  DampedBody() {
    SystemBuilder builder;
    const BodyIndex body = builder.add_flexible_body(
        "bar", share(testing::make_point_mass_body(12, 3, 1.0, 1.0, 10.0, 3)),
        Fidelity::coupled,
        {.maxwell = flexbody::find_maxwell_elements(0.1, {10.0, 20.0})});
    builder.add_coupler(
        "root",
        joints::make_joint(joints::JointKind::fixed, Vector3::UnitZ(), {},
                           {.translational_stiffness = kStiffness,
                            .rotational_stiffness = kStiffness}),
        builder.attach_world("ground", {}),
        builder.attach_frame("end", body, {}));
    model_ = builder.build();
    state_ = make_state(model_);
    state_.bodies[0].p_WB.x() = kDeflection;
  }

  SystemModel model_;
  SystemState state_;
};

TEST_F(DampedBody, HasTheElasticEnergyOfItsMaxwellElementsToo) {
  state_.eta[0] = 2e-3;
  const double modes = calc_energy(model_, state_).elastic;
  state_.maxwell.setConstant(4e-3);
  const double elastic = calc_energy(model_, state_).elastic;
  ASSERT_GT(elastic, 1.2 * modes);
  const double fraction =
      0.5 * kStiffness * kDeflection * kDeflection / elastic;
  EXPECT_THAT(find_constraint_warnings(model_, state_),
              ElementsAre(HasSubstr(fmt::format(
                  "{:.3g} % of the elastic energy", 100.0 * fraction))));
}

TEST_F(DampedBody, GetsNoWarningOfAJointBesideMaxwellElementsThatStoreMore) {
  state_.eta[0] = 1e-6;
  EXPECT_THAT(find_constraint_warnings(model_, state_), ::testing::SizeIs(1));
  state_.maxwell.setConstant(0.1);
  EXPECT_THAT(find_constraint_warnings(model_, state_), IsEmpty());
}

}  // namespace
}  // namespace limber::dynamics::deflection_observer_test
