// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/breakpoints.hpp"

#include <gtest/gtest.h>

namespace limber::dynamics {
namespace {

SimulationSettings make_settings() {
  SimulationSettings settings;
  settings.end_time = 2.0;
  settings.step = 5e-6;
  settings.step_changes = {{0.05, 1e-5}, {0.2, 4e-5}};
  return settings;
}

TEST(StepCount, IsOfTheLengthThatEachTimeHas) {
  const SimulationSettings settings = make_settings();
  EXPECT_NEAR(count_steps(settings, 0.0, 0.02), 4000.0, 1e-6);
  EXPECT_NEAR(count_steps(settings, 0.0, 2.0), 10000.0 + 15000.0 + 45000.0,
              1e-6);
  EXPECT_NEAR(count_steps(settings, 0.1, 0.3), 10000.0 + 2500.0, 1e-6);
  EXPECT_NEAR(count_steps(settings, 1.0, 2.0), 25000.0, 1e-6);
}

TEST(LongestStep, IsThatFromATimeOnOrOfAll) {
  const SimulationSettings settings = make_settings();
  EXPECT_EQ(find_longest_step(settings, 0.1), 1e-5);
  EXPECT_EQ(find_longest_step(settings), 4e-5);
}

}  // namespace
}  // namespace limber::dynamics
