// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/breakpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/sliding_masses.hpp"

namespace limber::dynamics::breakpoints_test {
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

SystemModel make_pushed_mass(const TimeFunction& function) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  builder.add_load("push", mass.frame, {1.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world, function);
  return builder.build();
}

// Steps end at the load's jump, not beside it; those to a tolerance are
// interpolated at the times that were asked for.
TEST(VisitedTimes, AreThoseOfJumpsThatOutputsMissByRoundOff) {
  const SystemModel model =
      make_pushed_mass(Constant{.from = 0.0, .until = 0.5});
  SimulationSettings settings;
  settings.end_time = 1.0;
  settings.step = 0.1;
  const double beside = 0.5 + 1e-13;
  settings.output_times = {0.0, beside, 1.0};
  EXPECT_EQ(find_visited_times(model, 0.0, settings),
            (std::vector<double>{0.0, 0.5, 1.0}));
  settings.tolerance = 1e-4;
  EXPECT_EQ(find_visited_times(model, 0.0, settings), settings.output_times);
}

// Of a pulse of 1 ms steps of 1 ms see nothing; that they begin within it
// counts.
TEST(Breakpoints, DivideAPulseThatStepsWouldMiss) {
  const SystemModel model =
      make_pushed_mass(Pulse{PulseShape::half_sine, 0.1, 1e-3});
  SimulationSettings settings;
  settings.end_time = 0.2;
  settings.step = 1e-5;
  const auto count_within = [&] {
    const auto marks = find_breakpoints(model, 0.0, settings);
    return std::count_if(marks.begin(), marks.end(), [](const Breakpoint& m) {
      return m.time > 0.1 && m.time < 0.101;
    });
  };
  EXPECT_EQ(count_within(), 0);
  settings.step_changes = {{0.15, 1e-3}};
  EXPECT_EQ(count_within(), 0);
  settings.step_changes = {{0.1005, 1e-3}};
  EXPECT_GE(count_within(), 4);
  settings.step_changes = {};
  settings.step = 1e-3;
  EXPECT_GE(count_within(), 4);
}

}  // namespace
}  // namespace limber::dynamics::breakpoints_test
