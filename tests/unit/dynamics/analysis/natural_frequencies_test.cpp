// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/natural_frequencies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/chain.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::natural_frequencies_test {
namespace {

using testing::add_mass;
using testing::add_rail;
using testing::Mass;

constexpr double kTurn = 2.0 * std::numbers::pi;

joints::ScalarSpring make_spring(double stiffness) {
  return joints::ScalarSpring(
      {.curve = joints::SpringCurve({.stiffness = stiffness, .extensions = {}}),
       .damping = 3.0});
}

TEST(NaturalFrequencies, OfTwoMassesBetweenSpringsAreTheClosedForm) {
  // m = 2, k = 50 to the ground on both sides and 30 between them.
  SystemBuilder builder;
  const Mass a = add_mass(builder, "a", 2.0);
  const Mass b = add_mass(builder, "b", 2.0);
  const CouplerIndex rail_a =
      add_rail(builder, a, "rail_a", {{0, make_spring(50.0)}});
  const CouplerIndex rail_b =
      add_rail(builder, b, "rail_b", {{0, make_spring(50.0)}});
  builder.add_joint_sum("between",
                        {.terms = {{rail_a, 0, -1.0}, {rail_b, 0, 1.0}}},
                        {make_spring(30.0)});
  const SystemModel model = builder.build();
  const VectorX f = find_natural_frequencies(model, make_state(model));
  ASSERT_EQ(f.size(), 12);
  EXPECT_NEAR(f[0], std::sqrt(50.0 / 2.0) / kTurn, 1e-6);
  EXPECT_NEAR(f[1], std::sqrt(110.0 / 2.0) / kTurn, 1e-6);
}

TEST(NaturalFrequencies, OfAPendulumUpsideDownAreUnstable) {
  SystemBuilder builder;
  const auto ball = builder.add_rigid_body(
      "ball", {1.0, 1e-2 * Matrix3(Matrix3::Identity())});
  builder.add_coupler(
      "hinge",
      joints::make_joint(
          joints::JointKind::revolute, Vector3::UnitY(), Vector3::UnitX(),
          {.translational_stiffness = 1e6, .rotational_stiffness = 1e6}),
      builder.attach_world("pivot", {}),
      builder.attach_frame("arm", ball,
                           {Matrix3::Identity(), Vector3(0, 0, -2.0)}));
  builder.set_gravity({0, 0, -9.81});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  // The hinge deflects by m g / k.
  state.bodies[0].p_WB.z() = 2.0 - 9.81e-6;
  const double omega = std::sqrt(9.81 * 2.0 / (4.0 + 1e-2));
  EXPECT_NEAR(find_natural_frequencies(model, state)[0], -omega / kTurn, 1e-5);
}

TEST(NaturalFrequencies, OfAFreeBodyAreThoseOfItsModesAndSixZeros) {
  testing::Chain chain = testing::make_chain({.bodies = 1, .modes = 3});
  const SystemModel model = chain.builder.build();
  const VectorX f = find_natural_frequencies(model, chain.state);
  ASSERT_EQ(f.size(), 9);
  EXPECT_EQ(f.head(6).cwiseAbs().maxCoeff(), 0.0);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(f[6 + k], std::sqrt(model.bodies[0].reduced->lambda[k]) / kTurn,
                1e-6);
  }
}

}  // namespace
}  // namespace limber::dynamics::natural_frequencies_test
