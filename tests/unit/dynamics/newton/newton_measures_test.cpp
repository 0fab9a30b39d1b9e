// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/newton_measures.hpp"

#include <gtest/gtest.h>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/joints/bushing.hpp"

namespace limber::dynamics::newton_measures_test {
namespace {

constexpr double kStiffness = 1e6;  // [N/m]

// A body held at a place `far` from the origin, by an arm of its own.
double find_gap(double far, double arm) {
  SystemBuilder builder;
  const auto body = builder.add_rigid_body("body", {1.0, Matrix3::Identity()});
  builder.add_coupler(
      "spring",
      joints::Bushing(
          {.translational_stiffness = kStiffness * Matrix3::Identity()}),
      builder.attach_world("wall", {Matrix3::Identity(), {far, 0.0, 0.0}}),
      builder.attach_frame("end", body,
                           {Matrix3::Identity(), {0.0, arm, 0.0}}));
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = {far, -arm, 0.0};
  SystemTerms terms = make_terms(model);
  calc_terms(model, state, Side::right, terms);
  std::vector<Vector6> gaps;
  find_roundoff_gaps(model, terms, 0.0, gaps);
  return gaps[0].head<3>().cwiseAbs().maxCoeff();
}

// eps of a length, times the stiffness; of all lengths that a frame's place is
// the sum of.
TEST(RoundoffGaps, GrowWithTheDistanceAndWithArms) {
  constexpr double kEpsilon = 2.3e-16;
  EXPECT_GT(find_gap(3.0, 0.0), kStiffness * kEpsilon * 3.0);
  EXPECT_LT(find_gap(3.0, 0.0), 100.0 * kStiffness * kEpsilon * 3.0);
  EXPECT_GT(find_gap(5.0, 0.0), find_gap(3.0, 0.0));
  const double by_arm = find_gap(3.0, 2.0) - find_gap(3.0, 0.0);
  EXPECT_GT(by_arm, kStiffness * kEpsilon * 2.0);
  EXPECT_NEAR(find_gap(3.0, 4.0) - find_gap(3.0, 2.0), by_arm, 1e-9 * by_arm);
}

Reversal compare(double first, double second) {
  SystemBuilder builder;
  builder.add_rigid_body("a", {4.0, Matrix3::Identity()});
  const SystemModel model = builder.build();
  std::vector<Reversal> reversals;
  const VectorX x = VectorX::LinSpaced(6, -1.0, 2.0);
  measure_reversal(model, MotionGroups(model), second * x, first * x,
                   reversals);
  return reversals.at(0);
}

TEST(Reversal, IsBackwardOrWhole) {
  EXPECT_TRUE(compare(1.0, -1.0).is_whole());
  EXPECT_TRUE(compare(1.0, -1.1).is_whole());
  EXPECT_FALSE(compare(1.0, -0.9).is_whole());
  EXPECT_FALSE(compare(1.0, 1.0).is_whole());
  EXPECT_FALSE(compare(0.0, 0.0).is_whole());
  EXPECT_TRUE(compare(1.0, -0.1).is_backward());
  EXPECT_FALSE(compare(1.0, 0.1).is_backward());
  EXPECT_FALSE(compare(0.0, 0.0).is_backward());
}

}  // namespace
}  // namespace limber::dynamics::newton_measures_test
