// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/stepping/error_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace limber::dynamics::error_budget_test {
namespace {

struct Spent {
  double error = 0.0;  // of all steps
  long steps = 0;
};

// A run of 1 s whose steps h take the whole error that they may have, C h^3.
Spent spend(double total, const std::function<double(double)>& rate) {
  ErrorBudget budget = ErrorBudget::in_all(total, 1.0);
  Spent spent;
  double t = 0.0;
  double h = 1e-4;
  while (t < 1.0) {
    const double error = budget.allowed();
    h = std::min(4.0 * h, std::cbrt(error / rate(t)));
    t += h;
    budget.count(h);
    spent.error += error;
    ++spent.steps;
  }
  return spent;
}

TEST(ErrorBudget, OfEachStepDoesNotDependOnTheirNumber) {
  ErrorBudget budget = ErrorBudget::each(2e-6);
  EXPECT_EQ(budget.allowed(), 2e-6);
  budget.count(0.5);
  EXPECT_EQ(budget.allowed(), 2e-6);
}

TEST(ErrorBudget, AddsUpToTheTotalHoweverManyEvenStepsThereAre) {
  for (const double total : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Spent spent = spend(total, [](double) { return 1.0; });
    EXPECT_GT(spent.steps, 0.9 / std::sqrt(total)) << total;
    EXPECT_GT(spent.error, 0.7 * total) << total;
    EXPECT_LT(spent.error, 1.5 * total) << total;
  }
}

// An impact makes errors of a step a billion times as large for a thousandth
// of the time: a thousand times as many steps there as without it.
TEST(ErrorBudget, AddsUpToAFewTotalsWhereverStepsAreShort) {
  for (const double impact : {0.0, 0.001, 0.5, 0.99}) {
    const Spent spent = spend(1e-7, [&](double t) {
      return t >= impact && t < impact + 1e-3 ? 1e9 : 1.0;
    });
    EXPECT_GT(spent.error, 0.2e-7) << impact;
    EXPECT_LT(spent.error, 5e-7) << impact;
    // Of equal errors, int C^(1/3) dt = 2 would be 2^(3/2) / sqrt(total).
    EXPECT_LT(static_cast<double>(spent.steps), 4.0 * std::sqrt(8.0 / 1e-7))
        << impact;
  }
}

TEST(ErrorBudget, GoesOnWithItsHistory) {
  ErrorBudget budget = ErrorBudget::in_all(1.0, 10.0);
  for (int i = 0; i < 7; ++i) budget.count(0.3);
  Archive written;
  budget.exchange_memory(written);
  ErrorBudget other = ErrorBudget::in_all(1.0, 10.0);
  Archive read(written.numbers());
  other.exchange_memory(read);
  EXPECT_EQ(other.allowed(), budget.allowed());
  EXPECT_NE(other.allowed(), ErrorBudget::in_all(1.0, 10.0).allowed());
}

}  // namespace
}  // namespace limber::dynamics::error_budget_test
