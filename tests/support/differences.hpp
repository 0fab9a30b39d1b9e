// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace limber::testing {

/// d f / d x at 0 of a number or an Eigen matrix, by central differences of
/// sixth order: with h = 1e-4 and functions of size and scale 1 the truncation
/// is below round-off, about 1e-12.
template <typename Function>
auto differentiate(const Function& f, double h = 1e-4) {
  using Value = decltype(f(0.0));
  const Value first = f(h) - f(-h);
  const Value second = f(2.0 * h) - f(-2.0 * h);
  const Value third = f(3.0 * h) - f(-3.0 * h);
  return Value((45.0 * first - 9.0 * second + third) / (60.0 * h));
}

/// Deviations of many comparisons against the largest value compared: there
/// must be one, or nothing was shown.
class Margin {
 public:
  void add(double deviation, double size) {
    if (!(deviation <= worst_)) worst_ = deviation;  // keeps NaN
    largest_ = std::max(largest_, size);
  }
  void expect_below(double tolerance) const {
    EXPECT_GT(largest_, 0.0) << "nothing was compared";
    EXPECT_LE(worst_, tolerance * largest_);
    ::testing::Test::RecordProperty(
        "deviation", fmt::format("{:.2e}", worst_ / (tolerance * largest_)));
  }
  [[nodiscard]] double worst() const { return worst_; }
  [[nodiscard]] double largest() const { return largest_; }

 private:
  double worst_ = 0.0;
  double largest_ = 0.0;
};

}  // namespace limber::testing
