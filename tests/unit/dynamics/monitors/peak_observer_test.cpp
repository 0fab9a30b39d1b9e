// SPDX-License-Identifier: BSD-3-Clause
// Extremes over all steps, against closed forms.
#include "limber/dynamics/monitors/peak_observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "support/point_mass_body.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::peak_observer_test {
namespace {

using std::numbers::pi;

constexpr double kOmega = 10.0;  // of the oscillator [rad/s]

// A mass on a spring that is kicked: x = v sin(10 t) / 10.
struct Kicked {
  SystemModel model;
  SystemState state;
};
Kicked make_kicked(double speed) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  joints::Bushing::Parameters spring;
  spring.translational_stiffness = 200.0 * Matrix3::Identity();
  builder.add_coupler("spring", joints::Bushing(spring),
                      builder.attach_world("wall", {}), mass.frame);
  Kicked out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].v_WB_W.x() = speed;
  return out;
}

// Position and velocity of the first body along x, and the force on it.
Followed follow_first() {
  Followed followed;
  followed.courses = {Course::motion, Course::motion, Course::values};
  followed.evaluate = [](const SystemState& state,
                         std::vector<double>& values) {
    const BodyState& body = state.bodies[0];
    values = {body.p_WB.x(), body.v_WB_W.x(), -200.0 * body.p_WB.x()};
  };
  return followed;
}

std::vector<double> sample(double end, double interval) {
  std::vector<double> times;
  for (int i = 0; i * interval < end * (1.0 - 1e-9); ++i) {
    times.push_back(i * interval);
  }
  times.push_back(end);
  return times;
}

RunRecord record_run(const Kicked& scene, const SimulationSettings& settings,
                     const Followed& followed) {
  SimulationStatistics statistics;
  RunRecord record;
  SystemState state = scene.state;
  simulate(scene.model, state, settings, {}, {}, statistics, {}, followed,
           record);
  return record;
}

std::vector<Extreme> run(const Kicked& scene,
                         const SimulationSettings& settings,
                         const Followed& followed) {
  return record_run(scene, settings, followed).peaks;
}

class PeaksOf : public ::testing::TestWithParam<IntegratorKind> {};

// The two outputs contain nothing of the motion.
TEST_P(PeaksOf, AnOscillatorAreThoseOfItsClosedFormWhateverTheOutputs) {
  const Kicked scene = make_kicked(1.0);
  SimulationSettings settings;
  settings.integrator = GetParam();
  settings.step = 2.0 * pi / kOmega / 40.3;
  settings.end_time = 1.1 * pi / kOmega;
  settings.output_times = {0.0, settings.end_time};
  const std::vector<Extreme> peaks = run(scene, settings, follow_first());
  ASSERT_EQ(peaks.size(), 3U);
  // What the scheme itself makes of amplitude and period with such steps.
  constexpr double kScheme = 0.005;
  EXPECT_NEAR(peaks[0].value, 0.1, 0.1 * kScheme);
  EXPECT_NEAR(peaks[0].time, 0.5 * pi / kOmega, 0.01 * pi / kOmega);
  EXPECT_NEAR(peaks[2].value, -20.0, 20.0 * kScheme);
  // Velocity: 1 at the start, -1 half a period on.
  EXPECT_NEAR(std::abs(peaks[1].value), 1.0, kScheme);
}

INSTANTIATE_TEST_SUITE_P(, PeaksOf,
                         ::testing::Values(IntegratorKind::generalized_alpha,
                                           IntegratorKind::runge_kutta_4,
                                           IntegratorKind::central_differences,
                                           IntegratorKind::energy_conserving,
                                           IntegratorKind::splitting));

TEST(Peaks, AreTheSameForOutputsHalfAMillisecondAndFiftyApart) {
  const Kicked scene = make_kicked(1.0);
  std::vector<Extreme> first;
  for (const double interval : {5e-4, 2e-3, 1e-2, 5e-2}) {
    SimulationSettings settings;
    settings.step = 5e-3;
    settings.end_time = 1.0;
    settings.output_times = sample(settings.end_time, interval);
    const std::vector<Extreme> peaks = run(scene, settings, follow_first());
    if (first.empty()) first = peaks;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
      EXPECT_NEAR(peaks[i].value / first[i].value, 1.0, 0.01) << interval;
    }
    EXPECT_NEAR(peaks[0].value, 0.1, 1e-4) << interval;
    EXPECT_NEAR(peaks[0].time, 0.5 * pi / kOmega, 1e-3) << interval;
  }
}

TEST(Peaks, OfStepsToAToleranceAreThoseOfTheLastPass) {
  const Kicked scene = make_kicked(1.0);
  SimulationSettings settings;
  settings.step = settings.end_time = 0.4;
  settings.tolerance = 1e-5;
  settings.output_times = {0.0, settings.end_time};
  const std::vector<Extreme> peaks = run(scene, settings, follow_first());
  EXPECT_NEAR(peaks[0].value, 0.1, 2e-5);
  EXPECT_NEAR(peaks[0].time, 0.5 * pi / kOmega, 1e-3);
}

// Between outputs a fifth of a period and more apart, which show little of it.
TEST(EnvelopesOfARun, AreThoseOfTheClosedFormInEachInterval) {
  const Kicked scene = make_kicked(1.0);
  for (const double tolerance : {0.0, 1e-6}) {
    SimulationSettings settings;
    settings.step = tolerance > 0.0 ? 1.0 : 2e-3;
    settings.tolerance = tolerance;
    settings.end_time = 1.0;
    settings.output_times = {0.0, 0.13, 0.4, 0.41, 1.0};
    const Envelopes found =
        record_run(scene, settings, follow_first()).envelopes;
    ASSERT_EQ(found.edges, settings.output_times);
    ASSERT_EQ(found.least.rows(), 4);
    constexpr double kScheme = 2e-4;
    for (Eigen::Index k = 0; k < 4; ++k) {
      double least = 1.0;
      double most = -1.0;
      const double from = found.edges[static_cast<std::size_t>(k)];
      const double to = found.edges[static_cast<std::size_t>(k) + 1];
      for (int i = 0; i <= 1000; ++i) {
        const double x =
            0.1 * std::sin(kOmega * (from + (to - from) * i / 1000));
        least = std::min(least, x);
        most = std::max(most, x);
      }
      // Free steps do not end on outputs: up to a step is missing there.
      const double missed = tolerance > 0.0 ? 0.02 : 0.0;
      EXPECT_NEAR(found.least(k, 0), least, kScheme + missed) << k;
      EXPECT_NEAR(found.most(k, 0), most, kScheme + missed) << k;
      EXPECT_NEAR(found.most(k, 2), -200.0 * least, 0.04 + 200.0 * missed) << k;
    }
  }
}

/// A mode of 50 rad/s and above under a load that begins at once: no steps.
struct ClosedRun {
  SimulationStatistics statistics;
  Extreme peak;         // of the mode
  double period = 0.0;  // [s]
  double twice = 0.0;   // of the static deflection
};

ClosedRun run_in_closed_form(double end) {
  testing::PointMassBody points =
      testing::make_point_mass_body(20, 1, 4.0, 1.0, 50.0, 1);
  points.reduced.clamped = true;
  SystemBuilder builder;
  const BodyIndex body = builder.add_flexible_body("b", testing::share(points),
                                                   Fidelity::uncoupled, {});
  const auto table = testing::make_interface(points, 0, 6);
  const AttachmentIndex tip = builder.attach_interface(
      "tip", body, table, {Matrix3::Identity(), table.p_B});
  builder.add_load("load", tip, {30.0, -20.0, 50.0}, Vector3::Zero(),
                   LoadFrame::body, Constant{});
  const SystemModel model = builder.build();
  SystemState state = make_state(model);
  const double lambda = model.bodies[0].reduced->lambda[0];
  const double force =
      (table.Phi_B.transpose() * Vector3(30.0, -20.0, 50.0))[0];
  SimulationSettings settings;
  settings.step = end;
  settings.end_time = end;
  settings.output_times = {0.0, end};
  Followed followed;
  followed.courses = {Course::motion};
  followed.evaluate = [](const SystemState& at, std::vector<double>& values) {
    values = {at.eta[0]};
  };
  ClosedRun closed;
  RunRecord record;
  simulate(model, state, settings, {}, {}, closed.statistics, {}, followed,
           record);
  closed.peak = record.peaks.at(0);
  closed.period = 2.0 * pi / std::sqrt(lambda);
  closed.twice = 2.0 * force / lambda;
  return closed;
}

TEST(Peaks, OfModesInClosedFormAreFoundBetweenOutputs) {
  const ClosedRun run = run_in_closed_form(3.0);
  EXPECT_EQ(run.statistics.steps, 0);
  EXPECT_TRUE(run.statistics.warnings.empty());
  // Twice the static deflection, half a period on or some periods later.
  const double phase = run.peak.time / run.period;
  EXPECT_NEAR(run.peak.value, run.twice, 5e-6 * std::abs(run.twice));
  EXPECT_NEAR(phase - std::floor(phase), 0.5, 0.01);
}

// Ten looks a period would be more than a million.
TEST(Peaks, OfTooManyPeriodsInClosedFormAreReportedToBeLow) {
  const double period = run_in_closed_form(1.0).period;
  EXPECT_TRUE(run_in_closed_form(9e4 * period).statistics.warnings.empty());
  const ClosedRun run = run_in_closed_form(2e5 * period);
  ASSERT_EQ(run.statistics.warnings.size(), 1U);
  EXPECT_NE(run.statistics.warnings[0].find("are sampled every"),
            std::string::npos);
}

// A ramp that is cut off: its largest value is that before the jump.
TEST(Peaks, OfWhatJumpsAreThoseBeforeAndAfterIt) {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  Pulse pulse;
  pulse.shape = PulseShape::rectangular;
  pulse.start = 0.0;
  pulse.duration = 0.5;
  builder.add_load("push", mass.frame, {1.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world, pulse);
  Kicked scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  Followed followed;
  followed.courses = {Course::values};
  followed.evaluate = [](const SystemState& at, std::vector<double>& values) {
    values = {at.t < 0.5 ? at.t : -0.1};
  };
  SimulationSettings settings;
  settings.step = 0.03;
  settings.end_time = 1.0;
  settings.output_times = {0.0, settings.end_time};
  const std::vector<Extreme> peaks = run(scene, settings, followed);
  EXPECT_NEAR(peaks[0].value, 0.5, 1e-12);
  EXPECT_EQ(peaks[0].time, 0.5);
}

// A step that is longer than a motion_observer allows is shown in parts,
// whenever.
TEST(Peaks, AreLookedForWithinStepsThatAreLong) {
  SystemBuilder builder;
  testing::add_mass(builder, "mass", 2.0);
  Kicked scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  scene.state.t = 1000.0;
  SimulationSettings settings;
  settings.step = 1.0;
  settings.end_time = 1004.0;
  settings.output_times = {settings.end_time};
  for (const auto& [longest, parts] : {std::pair(1.5, 1), std::pair(0.4, 3)}) {
    int shown = 0;
    Followed followed;
    followed.longest = longest;
    followed.courses = {Course::values};
    followed.evaluate = [](const SystemState&, std::vector<double>& values) {
      values = {1.0};
    };
    followed.motion_observer = MotionObserver{
        [] {}, [&](const SystemState&) { ++shown; }, [](Archive&) {}};
    run(scene, settings, followed);
    EXPECT_EQ(shown, 1 + 4 * parts) << longest;
  }
}

// Of the first and the last step only one neighbour has more to say.
TEST(Peaks, OfTheFirstAndTheLastStepAreFoundWithinThem) {
  SystemBuilder builder;
  testing::add_mass(builder, "mass", 2.0);
  Kicked scene{builder.build(), {}};
  scene.state = make_state(scene.model);
  Followed followed;
  followed.courses = {Course::values, Course::motion, Course::values,
                      Course::motion};
  followed.evaluate = [](const SystemState& at, std::vector<double>& values) {
    const double begun = 100.0 - 5.0 * std::pow(at.t - 0.3, 2);
    const double ends = 5.0 * std::pow(at.t - 3.7, 2) - 100.0;
    values = {begun, begun, ends, ends};
  };
  SimulationSettings settings;
  settings.step = 1.0;
  settings.end_time = 4.0;
  settings.output_times = {0.0, settings.end_time};
  const std::vector<Extreme> peaks = run(scene, settings, followed);
  ASSERT_EQ(peaks.size(), 4U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_NEAR(peaks[i].value, 100.0, 1e-9);
    EXPECT_NEAR(peaks[i].time, 0.3, 1e-9);
    EXPECT_NEAR(peaks[i + 2].value, -100.0, 1e-9);
    EXPECT_NEAR(peaks[i + 2].time, 3.7, 1e-9);
  }
}

TEST(Peaks, OfARunThatEndsEarlyAreThoseUpToThere) {
  const Kicked scene = make_kicked(1.0);
  SimulationSettings settings;
  settings.integrator = IntegratorKind::runge_kutta_4;
  settings.step = 1e4;  // beyond stability, and too long to be divided
  settings.end_time = 1e6;
  SimulationStatistics statistics;
  SystemState state = scene.state;
  RunRecord record;
  EXPECT_THROW(simulate(scene.model, state, settings, {}, {}, statistics, {},
                        follow_first(), record),
               NumericalError);
  const std::vector<Extreme>& peaks = record.peaks;
  ASSERT_EQ(peaks.size(), 3U);
  EXPECT_GT(std::abs(peaks[0].value), 0.1);
  EXPECT_LE(peaks[0].time, state.t);
}

// A free spin's rate differs by the last bits from step to step.
TEST(Extreme, OfAConstantIsAtItsFirstTimeWhateverItsRoundOff) {
  Extreme extreme{0.0, 0.0};
  for (int i = 0; i < 1000; ++i) {
    extreme.include(-0.3 * (1.0 + 1e-15 * i), 0.001 * i);
  }
  EXPECT_EQ(extreme, (Extreme{-0.3, 0.0}));
  EXPECT_TRUE(extreme.include(0.3 * (1.0 + 1e-10), 2.0));
  EXPECT_EQ(extreme.time, 2.0);
}

}  // namespace
}  // namespace limber::dynamics::peak_observer_test
