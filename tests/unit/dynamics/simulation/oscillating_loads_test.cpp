// SPDX-License-Identifier: BSD-3-Clause
// Loads and commands with periods shorter than steps that their forces alone
// would ask for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/joints/scalar/drive.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::oscillating_loads_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::run_from;
using testing::RunOutcome;

constexpr double kMass = 2.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

SimulationSettings make_settings(double tolerance, double end,
                                 TolerancePasses passes) {
  SimulationSettings settings;
  settings.end_time = end;
  settings.step = end;
  settings.tolerance = tolerance;
  settings.passes = passes;
  for (int i = 1; i <= 20; ++i) settings.output_times.push_back(end * i / 20);
  return settings;
}

// A free mass under F sin(w t + p).
struct Push {
  double force = 0.0;      // [N]
  double frequency = 0.0;  // [Hz]
  double phase = 0.0;      // [rad]
};

SystemModel make_pushed(const Push& push) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
  builder.add_load("push", mass.frame, {push.force, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world,
                   Sinusoid{.frequency = push.frequency, .phase = push.phase});
  return builder.build();
}

// x' = F / (m w) (cos p - cos(w t + p))
double find_place(const Push& push, double t) {
  const double w = kTurn * push.frequency;
  const double p = push.phase;
  return push.force / (kMass * w) *
         (t * std::cos(p) - (std::sin(w * t + p) - std::sin(p)) / w);
}

double find_error(const Push& push, const SimulationSettings& settings) {
  const SystemModel model = make_pushed(push);
  const RunOutcome run = run_from(model, make_state(model), settings);
  double largest = 0.0;
  for (const SystemState& state : run.states) {
    largest = std::max(largest, std::abs(state.bodies[0].p_WB.x() -
                                         find_place(push, state.t)));
  }
  return largest;
}

// Random scenes that missed the tolerance, one by four times with an estimate
// below it: steps that were multiples of the period saw a constant force.
TEST(OscillatingLoads, KeepTheToleranceOfAVerifiedRun) {
  constexpr auto kVerified = TolerancePasses::verified;
  const Push push{100.0, 30.100925911524655, 1.4735419309901217};
  const double tolerance = 0.0009354411264590665;
  EXPECT_LT(
      find_error(push, make_settings(tolerance, 1.1705582234895269, kVerified)),
      tolerance);
  for (const double phase : {-2.0, 0.0, 0.3, 1.6}) {
    for (const double allowed : {1e-2, 1e-3, 1e-4}) {
      const Push other{50.0, 12.5, phase};
      EXPECT_LT(find_error(other, make_settings(allowed, 1.0, kVerified)),
                allowed)
          << phase;
    }
  }
}

// To no tolerance is the work of a force left out that returns after a period.
TEST(OscillatingLoads, HaveSixteenStepsAPeriodWhateverTheTolerance) {
  const Push push{1.0, 20.0, 0.7};
  const SystemModel model = make_pushed(push);
  const RunOutcome run = run_from(
      model, make_state(model), make_settings(1e3, 1.0, TolerancePasses::one));
  EXPECT_GE(run.statistics.steps, 2 * 16 * 20);
  EXPECT_LT(run.statistics.steps, 2 * 16 * 20 + 60);
}

TEST(OscillatingLoads, AreNamedIfTheyTakeMoreStepsThanAllowed) {
  const SystemModel model = make_pushed({1.0, 2000.0, 0.7});
  SimulationSettings settings = make_settings(1.0, 1.0, TolerancePasses::one);
  settings.most_steps = 1000;
  try {
    (void)run_from(model, make_state(model), settings);
    FAIL() << "runs";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("load 'push' has a period of 0.0005 s"));
  }
}

// m x'' = -clip(k (x - s) + c (x' - s')) from rest, by the classical
// Runge-Kutta method, independent of all of the above.
struct Servo {
  double mean = 0.28460925298199213;       // [m]
  double amplitude = 0.06593412044782014;  // [m]
  double frequency = 9.819569671549402;    // [Hz]
  double stiffness = 200.0;                // [N/m]
  double damping = 0.5;                    // [N s/m]
  double limit = 3.4320193359561157;       // [N]
};

struct Course {
  std::vector<double> places;     // at the times that were asked for [m]
  std::vector<double> crossings;  // when the limit is reached or left [s]
};

Course integrate(const Servo& servo, const std::vector<double>& times) {
  const double w = kTurn * servo.frequency;
  const auto demand = [&](double t, double x, double v) {
    const double s = servo.mean + servo.amplitude * std::sin(w * t);
    const double rate = servo.amplitude * w * std::cos(w * t);
    return servo.stiffness * (x - s) + servo.damping * (v - rate);
  };
  const auto push = [&](double t, double x, double v) {
    return -std::clamp(demand(t, x, v), -servo.limit, servo.limit) / kMass;
  };
  Course course;
  double t = 0.0;
  double x = 0.0;
  double v = 0.0;
  for (const double until : times) {
    const int count = 4000;
    const double h = (until - t) / count;
    for (int i = 0; i < count; ++i, t += h) {
      const bool was_at = std::abs(demand(t, x, v)) >= servo.limit;
      const double a1 = push(t, x, v);
      const double v2 = v + 0.5 * h * a1;
      const double a2 = push(t + 0.5 * h, x + 0.5 * h * v, v2);
      const double v3 = v + 0.5 * h * a2;
      const double a3 = push(t + 0.5 * h, x + 0.5 * h * v2, v3);
      const double v4 = v + h * a3;
      const double a4 = push(t + h, x + h * v3, v4);
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
      const bool is_at = std::abs(demand(t + h, x, v)) >= servo.limit;
      if (is_at != was_at) course.crossings.push_back(t + 0.5 * h);
    }
    t = until;
    course.places.push_back(x);
  }
  return course;
}

SystemModel make_driven(const Servo& servo) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
  const joints::Drive drive(
      {.mode = joints::DriveMode::position,
       .signal = {joints::SineSignal{.mean = servo.mean,
                                     .amplitude = servo.amplitude,
                                     .frequency = servo.frequency}},
       .stiffness = servo.stiffness,
       .damping = servo.damping,
       .max_effort = servo.limit});
  testing::add_rail(builder, mass, "rail", {{.coordinate = 0, .law = drive}});
  return builder.build();
}

double find_error(const Servo& servo, const SimulationSettings& settings) {
  const SystemModel model = make_driven(servo);
  const RunOutcome run = run_from(model, make_state(model), settings);
  const std::vector<double> right =
      integrate(servo, settings.output_times).places;
  double largest = 0.0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    largest = std::max(largest,
                       std::abs(run.states[i].bodies[0].p_WB.x() - right[i]));
  }
  return largest;
}

// A drive at its limit pulls evenly: nothing in its effort shows that the
// command comes back. Such runs erred by 184 times the tolerance.
TEST(OscillatingCommands, KeepTheToleranceOfAVerifiedRunAtTheEffortLimit) {
  constexpr auto kVerified = TolerancePasses::verified;
  const double tolerance = 1.0924323882917619e-06;
  EXPECT_LT(find_error(Servo{}, make_settings(tolerance, 1.0, kVerified)),
            tolerance);
  for (const double limit : {1.0, 5.0, 20.0}) {
    for (const double frequency : {3.0, 25.0}) {
      const Servo servo{.frequency = frequency, .limit = limit};
      EXPECT_LT(find_error(servo, make_settings(1e-5, 1.0, kVerified)), 1e-5)
          << limit << ' ' << frequency;
    }
  }
}

// It starts at the limit, which is the first event. The third and fourth are
// 7 ms apart: steps that had both within them missed them in every pass.
TEST(OscillatingCommands, ReachAndLeaveTheEffortLimitWhenTheyDo) {
  const Servo servo;
  const SystemModel model = make_driven(servo);
  for (const auto passes : {TolerancePasses::one, TolerancePasses::verified}) {
    const SimulationSettings settings = make_settings(1e-6, 1.0, passes);
    const RunOutcome run = run_from(model, make_state(model), settings);
    const std::vector<double> right =
        integrate(servo, settings.output_times).crossings;
    const auto& events = run.statistics.events;
    ASSERT_EQ(events.size(), right.size() + 1);
    for (std::size_t i = 0; i < right.size(); ++i) {
      EXPECT_NEAR(events[i + 1].time, right[i], 2e-5) << i;
    }
  }
}

int count_passes(const SystemModel& model, const SimulationSettings& settings) {
  return run_from(model, make_state(model), settings).statistics.passes;
}

// One pass missed it by 1.6 times.
TEST(OscillatingCommands, KeepTheToleranceByDefault) {
  const double tolerance = 1.0924323882917619e-06;
  SimulationSettings settings = make_settings(tolerance, 1.0, {});
  settings.passes = SimulationSettings{}.passes;
  EXPECT_LT(find_error(Servo{}, settings), tolerance);
  EXPECT_GE(count_passes(make_driven(Servo{}), settings), 2);
}

TEST(OscillatingLoads, AreVerifiedByDefaultLikeOnAsking) {
  const Push push{50.0, 12.5, 0.3};
  const SystemModel model = make_pushed(push);
  const auto run_with = [&](TolerancePasses passes) {
    return run_from(model, make_state(model), make_settings(1e-4, 1.0, passes));
  };
  const RunOutcome asked = run_with(TolerancePasses::verified);
  const RunOutcome chosen = run_with(TolerancePasses::automatic);
  EXPECT_EQ(chosen.statistics.steps, asked.statistics.steps);
  EXPECT_EQ(chosen.states.back().bodies[0].p_WB,
            asked.states.back().bodies[0].p_WB);
  EXPECT_EQ(run_with(TolerancePasses::one).statistics.passes, 1);
}

// Neither a steady force, nor one that oscillates after the end only.
TEST(OscillatingLoads, AloneAreVerifiedByDefault) {
  const SimulationSettings settings =
      make_settings(1e-4, 1.0, TolerancePasses::automatic);
  const auto passes_of = [&](const TimeFunction& function) {
    SystemBuilder builder;
    const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
    builder.add_load("push", mass.frame, {1.0, 0.0, 0.0}, Vector3::Zero(),
                     LoadFrame::world, function);
    return count_passes(builder.build(), settings);
  };
  EXPECT_EQ(passes_of(Sinusoid{.frequency = 2.0, .from = 1.0}), 1);
  EXPECT_EQ(passes_of(Sinusoid{.frequency = 0.0, .phase = 1.0}), 1);
  EXPECT_GE(passes_of(Sinusoid{.frequency = 2.0, .from = 0.9}), 2);
}

// Those of periods; the energy has its own.
std::vector<std::string> find_warnings(const SystemModel& model, double step) {
  SimulationSettings settings;
  settings.end_time = 1.0;
  settings.step = step;
  std::vector<std::string> warnings =
      run_from(model, make_state(model), settings).statistics.warnings;
  std::erase_if(warnings, [](const std::string& warning) {
    return warning.find("has a period") == std::string::npos;
  });
  return warnings;
}

TEST(OscillatingLoads, WarnOfFixedStepsLongerThanAnEighthOfThePeriod) {
  const SystemModel model = make_pushed({1e-3, 20.0, 0.0});
  EXPECT_THAT(find_warnings(model, 0.05 / 7.0),
              ElementsAre(AllOf(HasSubstr("load 'push'"),
                                HasSubstr("a period of 0.05 s"),
                                HasSubstr("steps of 0.00714 s"))));
  EXPECT_TRUE(find_warnings(model, 0.05 / 8.0).empty());
}

TEST(OscillatingLoads, WarnOnlyOnceOfTheFastest) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
  const auto add = [&](const std::string& name, const Sinusoid& function) {
    builder.add_load(name, mass.frame, {1e-3, 0.0, 0.0}, Vector3::Zero(),
                     LoadFrame::world, function);
  };
  add("slow", {.frequency = 20.0});
  add("fast", {.frequency = 40.0});
  add("never", {.frequency = 80.0, .from = 2.0});
  EXPECT_THAT(find_warnings(builder.build(), 0.02),
              ElementsAre(HasSubstr("load 'fast'")));
}

TEST(OscillatingCommands, WarnOfFixedStepsThatDoNotFollowThem) {
  EXPECT_THAT(find_warnings(make_driven({.limit = 1e3}), 0.02),
              ElementsAre(HasSubstr("the drive of 'rail' has a period of "
                                    "0.102 s")));
}

}  // namespace
}  // namespace limber::dynamics::oscillating_loads_test
