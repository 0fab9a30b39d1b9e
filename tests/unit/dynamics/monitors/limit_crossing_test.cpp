// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/limit_crossing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/joints/scalar/drive.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::limit_crossing_test {
namespace {

using joints::Drive;
using joints::DriveMode;
using joints::Signal;

constexpr double kStiffness = 10.0;  // N/m

SystemModel make_model(const Drive::Parameters& parameters) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  testing::add_rail(builder, mass, "rail",
                    {{.coordinate = 0, .law = Drive(parameters)}});
  return builder.build();
}

Drive::Parameters make_holding(const Signal& signal) {
  return {.mode = DriveMode::position,
          .signal = signal,
          .stiffness = kStiffness,
          .max_effort = 2.0};
}

// Over a step of 1 s in which the mass moves evenly from one place to another.
std::optional<double> find_over_step(const Drive::Parameters& parameters,
                                     double from, double to) {
  const SystemModel model = make_model(parameters);
  SystemState before = make_state(model);
  before.bodies[0].p_WB.x() = from;
  before.bodies[0].v_WB_W.x() = to - from;
  SystemState after = before;
  after.t = 1.0;
  after.bodies[0].p_WB.x() = to;
  return LimitCrossing(model).find_first(before, after);
}

const Signal kZero{joints::ConstantSignal{}};

TEST(LimitCrossing, IsWhereTheEffortReachesOrLeavesTheLimit) {
  for (const double sign : {1.0, -1.0}) {
    const auto reached = find_over_step(make_holding(kZero), 0.0, sign * 1.0);
    ASSERT_TRUE(reached);
    EXPECT_NEAR(*reached, 0.2, 1e-8);
    const auto left = find_over_step(make_holding(kZero), sign * 1.0, 0.0);
    ASSERT_TRUE(left);
    EXPECT_NEAR(*left, 0.8, 1e-8);
  }
}

TEST(LimitCrossing, IsFoundWhereTheEffortIsFreeAtBothEnds) {
  // A command of half a sine, to 1.5 times the limit.
  const auto reached = find_over_step(
      make_holding({joints::SineSignal{.amplitude = 0.3, .frequency = 0.5}}),
      0.0, 0.0);
  ASSERT_TRUE(reached);
  EXPECT_NEAR(*reached, std::asin(2.0 / 3.0) / std::numbers::pi, 1e-8);
}

TEST(LimitCrossing, IsNoneWithinTheLimitsBeyondThemAndAtTheEndsOfAStep) {
  EXPECT_FALSE(find_over_step(make_holding(kZero), -0.19, 0.19));
  EXPECT_FALSE(find_over_step(make_holding(kZero), 0.3, 0.9));
  EXPECT_FALSE(find_over_step(make_holding(kZero), 0.2, 0.9));
  EXPECT_FALSE(find_over_step(make_holding(kZero), 0.0, 0.2));
}

// Of a stiff drive, for a thousandth of the step.
TEST(LimitCrossing, IsWhereTheEffortGoesFromOneLimitToTheOther) {
  Drive::Parameters stiff = make_holding(kZero);
  stiff.stiffness = 4e3;
  const auto left = find_over_step(stiff, 0.3, -0.7);
  ASSERT_TRUE(left);
  EXPECT_NEAR(*left, 0.3, 2.0 / 4e3 + 1e-8);
}

TEST(LimitCrossing, OfADriveThatOnlyPullsIsAlsoWhereItGoesSlack) {
  Drive::Parameters tendon = make_holding(kZero);
  tendon.pulls_only = true;
  const auto slack = find_over_step(tendon, 0.1, -0.3);
  ASSERT_TRUE(slack);
  EXPECT_NEAR(*slack, 0.25, 1e-8);
}

TEST(LimitCrossing, OfAVelocityDriveFollowsTheRateWithinTheStep) {
  // From rest over 1 m to rest: the rate is 6 s (1 - s), the limit at 1 m/s.
  const SystemModel model = make_model({.mode = DriveMode::velocity,
                                        .signal = kZero,
                                        .damping = 2.0,
                                        .max_effort = 2.0});
  const SystemState before = make_state(model);
  SystemState after = before;
  after.t = 1.0;
  after.bodies[0].p_WB.x() = 1.0;
  const auto reached = LimitCrossing(model).find_first(before, after);
  ASSERT_TRUE(reached);
  EXPECT_NEAR(*reached, 0.5 - std::sqrt(1.0 / 12.0), 1e-8);
}

TEST(LimitCrossing, IsNoneOfDrivesWithoutALimit) {
  Drive::Parameters free = make_holding(kZero);
  free.max_effort = Drive::kUnlimited;
  EXPECT_TRUE(LimitCrossing(make_model(free)).is_empty());
}

}  // namespace
}  // namespace limber::dynamics::limit_crossing_test
