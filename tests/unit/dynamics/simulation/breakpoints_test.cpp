// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/breakpoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "limber/joints/scalar/drive.hpp"
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
  const double beside = 0.5 + 3e-16;
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

// By different sums one time has different last digits; others do not.
TEST(Breakpoints, AreOneOnlyIfTheyDifferByTheRoundOffOfTheirTimes) {
  SimulationSettings settings;
  settings.end_time = 1e6;
  settings.step = 1e6;
  const auto count_after = [&](double gap) {
    const SystemModel model =
        make_pushed_mass(Table{{0.1 + 0.2, 0.3 + gap, 1.0}, {1.0, 1.0, 1.0}});
    return find_breakpoints(model, 0.0, settings).size();
  };
  ASSERT_NE(0.1 + 0.2, 0.3);
  EXPECT_EQ(count_after(2e-16), 3U);
  EXPECT_EQ(count_after(1e-14), 4U);
  EXPECT_EQ(count_after(1e-7), 4U);
}

// 1 N during a millionth of a second, whatever comes after it.
TEST(Breakpoints, KeepTheImpulseOfAPulseInARunOfAnyDuration) {
  const SystemModel model =
      make_pushed_mass(Pulse{PulseShape::rectangular, 1e-6, 5e-7});
  for (const double end : {1.0, 1e3, 1e6}) {
    SimulationSettings settings;
    settings.end_time = settings.step = end;
    for (const double tolerance : {0.0, 1e-3}) {
      settings.tolerance = tolerance;
      const auto run = testing::run_from(model, make_state(model), settings);
      // To the round-off of 0.5 m/s^2 that stop when the force does.
      EXPECT_NEAR(run.state.bodies[0].v_WB_W.x(), 5e-7 / 2.0, 1e-16 * end)
          << end << ' ' << tolerance;
    }
  }
}

// A mass between springs, pushed and driven, from `start` on.
SystemState run_shifted(double start, double tolerance) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  const joints::Drive drive(
      {.mode = joints::DriveMode::position,
       .signal = {joints::RampSignal{.to = 0.3,
                                     .start = start + 0.125,
                                     .duration = 0.5,
                                     .shape = joints::RampShape::trapezoid},
                  {{0.5, 0.0}, {0.5, 0.0625}}},
       .stiffness = 300.0});
  testing::add_rail(builder, mass, "rail", {{.coordinate = 0, .law = drive}});
  builder.add_load("push", mass.frame, {1.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world,
                   Sinusoid{.frequency = 3.0, .from = start + 0.25});
  builder.add_load("hit", mass.frame, {10.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world,
                   Pulse{PulseShape::half_sine, start + 0.5, 0.0078125});
  builder.add_load("blow", mass.frame, {1e7, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world,
                   Pulse{PulseShape::rectangular, start + 0.75, 0x1p-28});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  state.t = start;
  SimulationSettings settings;
  settings.end_time = start + 1.0;
  settings.step = 0.001;
  settings.tolerance = tolerance;
  // Later passes choose steps by a difference of two: more round-off.
  settings.passes = TolerancePasses::one;
  simulate(model, state, settings, {});
  return state;
}

// Round-off of times is 2e-12 s there, at up to 1 m/s and 100 m/s^2. Lengths of
// steps to a tolerance go by errors, which have more of it.
TEST(Motion, IsTheSameAtALaterTime) {
  for (const double tolerance : {0.0, 1e-6}) {
    const SystemState now = run_shifted(0.0, tolerance);
    const SystemState late = run_shifted(1e4, tolerance);
    EXPECT_GT(now.bodies[0].p_WB.x(), 0.1);
    EXPECT_NEAR(late.bodies[0].p_WB.x(), now.bodies[0].p_WB.x(),
                1e-11 + 1e-3 * tolerance);
    // The spring's 12 rad/s turn places into velocities.
    EXPECT_NEAR(late.bodies[0].v_WB_W.x(), now.bodies[0].v_WB_W.x(),
                1e-9 + 12e-3 * tolerance);
  }
}

}  // namespace
}  // namespace limber::dynamics::breakpoints_test
