// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/factor_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::dynamics::factor_plan_test {
namespace {

CorrectionSize make_size(double rigid, double modal) {
  return {std::hypot(rigid, modal), 0, rigid, modal};
}

// Corrections of 1 and 0.01 m.
FactorPlan::Course measure(double slowest = 0.01) {
  FactorPlan::Course course(1);
  course.add({make_size(0.6, 0.8)});
  course.add({make_size(0.006, 0.008)});
  course.slowest = slowest;
  course.is_measured = true;
  return course;
}

// One in which nothing contracted measurably.
FactorPlan::Course leave_unmeasured() {
  FactorPlan::Course course(1);
  course.add({make_size(0.6, 0.8)});
  return course;
}

int count_fresh(FactorPlan& plan) {
  int steps = 0;
  for (; !plan.keeps(); ++steps) plan.finish_step(false, measure());
  return steps;
}

TEST(FactorPlan, KeepsFactorsFromTheStartAndWhileTheyContractWell) {
  FactorPlan plan(1);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(plan.keeps());
    plan.finish_step(true, measure());
  }
}

TEST(FactorPlan, ExpectsWhatWasMeasuredInProportionTwentyTimes) {
  FactorPlan plan(1);
  plan.finish_step(true, measure());
  const auto rest = plan.expect_rest(0, 0, make_size(0.3, 0.4));
  EXPECT_NEAR(rest.rigid, 20.0 * 0.5 * 0.006, 1e-15);
  EXPECT_NEAR(rest.modal, 20.0 * 0.5 * 0.008, 1e-15);
}

TEST(FactorPlan, ExpectsNothingOfMuchLargerOrLaterCorrections) {
  FactorPlan plan(1);
  plan.finish_step(true, measure());
  EXPECT_TRUE(
      std::isfinite(plan.expect_rest(0, 0, make_size(2.34, 3.12)).rigid));
  EXPECT_TRUE(std::isinf(plan.expect_rest(0, 0, make_size(2.46, 3.28)).rigid));
  EXPECT_TRUE(std::isinf(plan.expect_rest(1, 0, make_size(0.3, 0.4)).modal));
  EXPECT_TRUE(std::isinf(plan.expect_rest(0, 0, make_size(NAN, 0.4)).modal));
}

TEST(FactorPlan, TrustsAMeasurementForEightSteps) {
  FactorPlan plan(1);
  EXPECT_TRUE(std::isinf(plan.expect_rest(0, 0, make_size(0.3, 0.4)).rigid));
  plan.finish_step(true, measure());
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(
        std::isfinite(plan.expect_rest(0, 0, make_size(0.3, 0.4)).rigid));
    plan.finish_step(true, leave_unmeasured());
  }
  EXPECT_TRUE(std::isinf(plan.expect_rest(0, 0, make_size(0.3, 0.4)).rigid));
}

TEST(FactorPlan, MakesNewFactorsAfterThirtyTwoStepsWithoutAMeasurement) {
  FactorPlan plan(1);
  for (int i = 0; i < 32; ++i) {
    plan.finish_step(true, leave_unmeasured());
    ASSERT_TRUE(plan.keeps());
  }
  plan.finish_step(true, leave_unmeasured());
  EXPECT_EQ(count_fresh(plan), 1);
}

TEST(FactorPlan, DoublesTheFreshStepsOfFactorsThatSoonContractBadly) {
  FactorPlan plan(1);
  int expected = 8;
  for (int failure = 0; failure < 9; ++failure) {
    plan.finish_step(true, measure(0.9));
    EXPECT_EQ(count_fresh(plan), expected);
    expected = std::min(2 * expected, 512);
  }
}

TEST(FactorPlan, RenewsFactorsOnceThatContractBadlyAfterManySteps) {
  FactorPlan plan(1);
  for (int i = 0; i < 200; ++i) plan.finish_step(true, measure());
  plan.finish_step(true, measure(0.9));
  EXPECT_EQ(count_fresh(plan), 1);
}

TEST(FactorPlan, ForgetsMeasurementsWhenRefreshed) {
  FactorPlan plan(1);
  plan.finish_step(true, measure());
  plan.refresh();
  EXPECT_TRUE(std::isinf(plan.expect_rest(0, 0, make_size(0.3, 0.4)).rigid));
}

}  // namespace
}  // namespace limber::dynamics::factor_plan_test
