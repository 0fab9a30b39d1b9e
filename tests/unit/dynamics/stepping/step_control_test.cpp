// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/step_control.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dynamics::step_control_test {
namespace {

SystemState make_spinning(double rate) {
  SystemState state;
  state.bodies.resize(2);
  state.bodies[1].w_WB_B = Vector3(0.0, rate, 0.0);
  return state;
}

// With a first step of 1e-4 s.
StepControl make_control(double longest = 1.0, double refinement = 1.0) {
  StepControl control(ErrorBudget::each(1e-6), longest, refinement);
  control.begin(1e-4);
  return control;
}

TEST(StepControl, BeginsWithAStepOfAtMostTheLongest) {
  EXPECT_DOUBLE_EQ(make_control().step(), 1e-4);
  EXPECT_DOUBLE_EQ(make_control(2e-5).step(), 2e-5);
  EXPECT_DOUBLE_EQ(make_control(2e-4, 0.25).step(), 5e-5);
}

TEST(StepControl, TakesTheNextStepFromTheCubicRootOfTheError) {
  StepControl control = make_control();
  EXPECT_TRUE(control.accepts(1e-4, 0.8e-6 / 8.0));
  EXPECT_NEAR(control.step(), 2e-4, 1e-15);
}

TEST(StepControl, GrowsByFourAtMostAndByHalfOrNotAtAll) {
  StepControl far = make_control();
  EXPECT_TRUE(far.accepts(1e-4, 1e-12));
  EXPECT_NEAR(far.step(), 4e-4, 1e-15);
  StepControl exact = make_control();
  EXPECT_TRUE(exact.accepts(1e-4, 0.0));
  EXPECT_NEAR(exact.step(), 4e-4, 1e-15);
  StepControl hardly = make_control();
  EXPECT_TRUE(hardly.accepts(1e-4, 0.8e-6 / std::pow(1.45, 3)));
  EXPECT_NEAR(hardly.step(), 1e-4, 1e-15);
  StepControl worth_it = make_control();
  EXPECT_TRUE(worth_it.accepts(1e-4, 0.8e-6 / std::pow(1.55, 3)));
  EXPECT_NEAR(worth_it.step(), 1.55e-4, 1e-12);
}

TEST(StepControl, GrowsFromFullStepsAlone) {
  StepControl control = make_control();
  EXPECT_TRUE(control.accepts(0.5e-4, 1e-12));
  EXPECT_DOUBLE_EQ(control.step(), 1e-4);
}

TEST(StepControl, ShrinksAfterAStepThatIsHardlyAccepted) {
  StepControl control = make_control();
  EXPECT_TRUE(control.accepts(1e-4, 0.95e-6));
  EXPECT_NEAR(control.step(), 1e-4 * std::cbrt(0.8 / 0.95), 1e-15);
}

TEST(StepControl, RepeatsARejectedStepWithASmallerOne) {
  StepControl control = make_control();
  EXPECT_FALSE(control.accepts(1e-4, 6.4e-6));
  EXPECT_NEAR(control.step(), 0.5e-4, 1e-15);
  StepControl hardly = make_control();
  EXPECT_FALSE(hardly.accepts(1e-4, 1.01e-6));
  EXPECT_NEAR(hardly.step(), 0.9e-4, 1e-15);
  StepControl far_off = make_control();
  EXPECT_FALSE(far_off.accepts(1e-4, 1.0));
  EXPECT_NEAR(far_off.step(), 1e-5, 1e-15);
  StepControl broken = make_control();
  EXPECT_FALSE(broken.accepts(1e-4, std::nan("")));
  EXPECT_NEAR(broken.step(), 1e-5, 1e-15);
}

TEST(StepControl, DoesNotGrowRightAfterARejection) {
  StepControl control = make_control();
  EXPECT_FALSE(control.accepts(1e-4, 6.4e-6));
  EXPECT_TRUE(control.accepts(0.5e-4, 1e-12));
  EXPECT_NEAR(control.step(), 0.5e-4, 1e-15);
  EXPECT_TRUE(control.accepts(0.5e-4, 1e-12));
  EXPECT_NEAR(control.step(), 2e-4, 1e-15);
}

TEST(StepControl, TurnsNoBodyByMoreThanARadian) {
  const StepControl control = make_control();
  EXPECT_DOUBLE_EQ(control.propose(make_spinning(5e3), 1.0), 1e-4);
  EXPECT_DOUBLE_EQ(control.propose(make_spinning(2e4), 1.0), 0.5e-4);
  const StepControl finer = make_control(1.0, 0.5);
  EXPECT_DOUBLE_EQ(finer.propose(make_spinning(2e4), 1.0), 0.25e-4);
}

TEST(StepControl, DividesWhatIsLeftIntoEqualSteps) {
  const StepControl control = make_control();
  const SystemState still = make_spinning(0.0);
  EXPECT_DOUBLE_EQ(control.propose(still, 0.7e-4), 0.7e-4);
  EXPECT_DOUBLE_EQ(control.propose(still, 1.4e-4), 0.7e-4);
  EXPECT_DOUBLE_EQ(control.propose(still, 2.1e-4), 1e-4);
}

TEST(StepControl, ExceedsTheLongestStepNever) {
  StepControl control = make_control(1.5e-4);
  EXPECT_TRUE(control.accepts(1e-4, 1e-12));
  EXPECT_DOUBLE_EQ(control.propose(make_spinning(0.0), 1.0), 1.5e-4);
}

TEST(StepControl, HalvesAfterAFailure) {
  StepControl control = make_control();
  control.halve();
  EXPECT_DOUBLE_EQ(control.step(), 0.5e-4);
}

TEST(StepControl, ShortensAllLimitsByTheRefinement) {
  SystemState turning;
  turning.bodies.resize(1);
  turning.bodies[0].w_WB_B = {0.0, 0.0, 100.0};
  const SystemState resting;
  const auto settle = [](StepControl control, const SystemState& state) {
    double h = 0.0;
    for (int i = 0; i < 20; ++i) {
      h = control.propose(state, 100.0);
      EXPECT_TRUE(control.accepts(h, 0.0));
    }
    return h;
  };
  EXPECT_DOUBLE_EQ(
      settle(StepControl(ErrorBudget::each(1.0), 0.3, 0.25), resting), 0.075);
  EXPECT_DOUBLE_EQ(
      settle(StepControl(ErrorBudget::each(1.0), 0.3, 0.25), turning), 0.0025);
}

TEST(StepControl, PlansFourStepsToAMarkAndSixteenToAPeriod) {
  const SystemState still = make_spinning(0.0);
  const double never = 1e9;
  const StepControl control(
      ErrorBudget::each(1e-6), 1.0, 0.5,
      {{.name = "load 'l'", .period = 0.8, .from = 4.0, .until = 6.0}});
  const auto expect = [&](const PlannedStep& step, double h, StepCause cause) {
    EXPECT_DOUBLE_EQ(step.length, h);
    EXPECT_EQ(step.cause, cause);
  };
  expect(control.plan(still, 0.0, 100.0, never), 0.5, StepCause::given);
  expect(control.plan(still, 0.0, 2.0, never), 0.25, StepCause::breakpoint);
  expect(control.plan(still, 0.0, 10.0, never), 0.025, StepCause::oscillation);
  expect(control.plan(still, 0.0, 2.0, 0.01), 0.005, StepCause::impact);
  EXPECT_EQ(control.describe_oscillation(0.0, 10.0, 0.025),
            "load 'l' has a period of 0.8 s, which they follow");
  EXPECT_EQ(control.describe_oscillation(0.0, 10.0, 0.01), "");
  EXPECT_EQ(control.describe_oscillation(0.0, 100.0, 0.025), "");
}

}  // namespace
}  // namespace limber::dynamics::step_control_test
