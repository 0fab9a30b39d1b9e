// SPDX-License-Identifier: BSD-3-Clause
// Steps to a tolerance, against closed forms and fine fixed steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/stepping/step_control.hpp"
#include "limber/dynamics/system/interpolation.hpp"
#include "support/chain.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::tolerance_test {
namespace {

using testing::run_from;
using testing::RunOutcome;

std::vector<double> sample(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

SimulationSettings to_tolerance(double tolerance, double end, int outputs) {
  SimulationSettings settings;
  settings.end_time = end;
  settings.step = end;
  settings.tolerance = tolerance;
  settings.passes = TolerancePasses::verified;
  settings.output_times = sample(end, outputs);
  return settings;
}

// A mass on a spring: x = cos(10 t).
struct Oscillator {
  SystemModel model;
  SystemState state;
};
Oscillator make_oscillator() {
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  joints::Bushing::Parameters spring;
  spring.translational_stiffness = 200.0 * Matrix3::Identity();
  builder.add_coupler("spring", joints::Bushing(spring),
                      builder.attach_world("wall", {}), mass.frame);
  Oscillator out{builder.build(), {}};
  out.state = make_state(out.model);
  out.state.bodies[0].p_WB.x() = 1.0;
  return out;
}

// A constant force on a free mass: its power is linear in time, also within
// steps.
TEST(Tolerance, WorkAtOutputsWithinStepsIsThatOfAConstantForce) {
  constexpr double kMass = 2.0;
  constexpr double kForce = 3.0;
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", kMass);
  builder.add_load("push", mass.frame, {kForce, 0, 0}, Vector3::Zero(),
                   LoadFrame::world, Constant{});
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model), to_tolerance(1e-2, 2.0, 1000));
  EXPECT_LT(r.statistics.steps, 500);
  ASSERT_EQ(r.energies.size(), 1001U);
  for (std::size_t i = 0; i < r.energies.size(); ++i) {
    const double impulse = kForce * r.states[i].t;
    ASSERT_NEAR(r.energies[i].work, impulse * impulse / (2.0 * kMass), 1e-9)
        << i;
  }
}

class ToleranceOf : public ::testing::TestWithParam<double> {};

TEST_P(ToleranceOf, HoldsAtEveryOutputOfAnOscillator) {
  const Oscillator o = make_oscillator();
  const RunOutcome r =
      run_from(o.model, o.state, to_tolerance(GetParam(), 2.0, 37));
  ASSERT_EQ(r.states.size(), 38U);
  double largest = 0.0;
  for (const SystemState& state : r.states) {
    largest = std::max(
        largest, std::abs(state.bodies[0].p_WB.x() - std::cos(10.0 * state.t)));
  }
  EXPECT_LT(largest, GetParam());
  // The estimate is of the same size as the error.
  EXPECT_LT(largest, 2.0 * r.statistics.estimated_error);
  EXPECT_GT(largest, 0.1 * r.statistics.estimated_error);
}

INSTANTIATE_TEST_SUITE_P(, ToleranceOf, ::testing::Values(1e-3, 1e-5, 1e-7));

// Errors of thousands of steps add up, so that each has its fraction.
TEST(Tolerance, IsKeptInOnePassHoweverManyStepsItTakes) {
  const Oscillator o = make_oscillator();
  for (const double end : {0.3, 3.0, 30.0}) {
    for (const double tolerance : {1e-2, 1e-4}) {
      SimulationSettings settings = to_tolerance(tolerance, end, 100);
      settings.passes = TolerancePasses::one;
      const RunOutcome r = run_from(o.model, o.state, settings);
      EXPECT_EQ(r.statistics.passes, 1);
      double largest = 0.0;
      for (const SystemState& state : r.states) {
        const double right = std::cos(10.0 * state.t);
        largest = std::max(largest, std::abs(state.bodies[0].p_WB.x() - right));
      }
      EXPECT_LT(largest, 1.5 * tolerance) << end;
      EXPECT_GT(largest, 0.01 * tolerance) << end;
    }
  }
}

TEST(Tolerance, CountsTheSolutionsOfAllPasses) {
  const Oscillator o = make_oscillator();
  const SimulationStatistics statistics =
      run_from(o.model, o.state, to_tolerance(1e-5, 2.0, 3)).statistics;
  EXPECT_GE(statistics.passes, 2);
  EXPECT_GE(statistics.newton_iterations, statistics.steps);
  EXPECT_GE(statistics.linear_solves, statistics.newton_iterations);
}

TEST(Tolerance, TellsTheShareOfTheTimeThatIsDone) {
  const Oscillator o = make_oscillator();
  for (const double tolerance : {0.0, 1e-5}) {
    SystemState state = o.state;
    state.t = 1.0;
    SimulationSettings settings = to_tolerance(tolerance, 3.0, 3);
    settings.step = tolerance > 0.0 ? 3.0 : 1e-3;
    double largest = 0.0;
    SimulationStatistics statistics;
    simulate(
        o.model, state, settings, {},
        [&](std::string_view, double fraction) {
          EXPECT_GE(fraction, 0.0);
          EXPECT_LE(fraction, 1.0);
          largest = std::max(largest, fraction);
        },
        statistics);
    EXPECT_GT(largest, 0.5) << tolerance;
  }
}

TEST(Tolerance, MakesStepsShortOnlyWhereTheyMustBe) {
  // A pulse of 1 ms on a free mass, and a long way after it.
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  Pulse pulse;
  pulse.shape = PulseShape::half_sine;
  pulse.start = 0.1;
  pulse.duration = 1e-3;
  builder.add_load("hit", mass.frame, {4000.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world, pulse);
  const SystemModel model = builder.build();
  const RunOutcome r =
      run_from(model, make_state(model), to_tolerance(1e-6, 10.0, 10));
  // Impulse 2/pi F T, from its middle on.
  const double speed = 2.0 / std::numbers::pi * 4000.0 * 1e-3 / 2.0;
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), speed * (10.0 - 0.1005), 1e-6);
  // The speed is right to 1e-7, which equal steps are by a thousandth of the
  // pulse: ten million of them.
  EXPECT_LT(r.statistics.steps, 10000);
}

TEST(Tolerance, IsKeptAndItsErrorKnownAfterABlowFarShorterThanSteps) {
  // No error holds steps back within the blow, only how few there may be.
  SystemBuilder builder;
  const testing::Mass mass = testing::add_mass(builder, "mass", 2.0);
  builder.add_load("hit", mass.frame, {4000.0, 0.0, 0.0}, Vector3::Zero(),
                   LoadFrame::world, Pulse{PulseShape::half_sine, 0.1, 1e-3});
  const SystemModel model = builder.build();
  const double speed = 2.0 / std::numbers::pi * 4000.0 * 1e-3 / 2.0;
  for (const double tolerance : {1e-1, 1e-2, 1e-3}) {
    const RunOutcome r =
        run_from(model, make_state(model), to_tolerance(tolerance, 1.0, 10));
    const double error =
        std::abs(r.state.bodies[0].p_WB.x() - speed * (1.0 - 0.1005));
    EXPECT_LT(error, tolerance);
    EXPECT_LT(error, 3.0 * r.statistics.estimated_error) << tolerance;
  }
}

TEST(Tolerance, OfAnUnknownSchemeIsRefused) {
  const Oscillator o = make_oscillator();
  SimulationSettings settings = to_tolerance(1e-3, 1.0, 2);
  settings.integrator = IntegratorKind::runge_kutta_4;
  SystemState state = o.state;
  EXPECT_THROW(simulate(o.model, state, settings, {}), InputError);
}

TEST(Tolerance, IsKeptByAFlexibleChainOnStiffHinges) {
  testing::Chain chain =
      testing::make_chain({.bodies = 3,
                           .modes = 4,
                           .stiffness = 1e8,
                           .joint = joints::JointKind::revolute});
  chain.builder.set_gravity({0.0, -9.81, 0.0});
  const SystemModel model = chain.builder.build();
  SystemState start = chain.state;
  for (BodyState& body : start.bodies) body.w_WB_B.x() = 0.5;
  // All turn about the first one's centre, as one.
  for (BodyState& body : start.bodies) {
    body.v_WB_W = start.bodies[0].w_WB_B.cross(body.p_WB);
  }
  const double tolerance = 1e-5;
  const RunOutcome r = run_from(model, start, to_tolerance(tolerance, 0.5, 5));
  SimulationSettings fixed = to_tolerance(0.0, 0.5, 5);
  fixed.step = 1e-5;
  const RunOutcome fine = run_from(model, start, fixed);
  const MotionScale scale(model);
  for (std::size_t i = 0; i < fine.states.size(); ++i) {
    // What the last pass is off by is estimated, not known.
    EXPECT_LT(scale.measure_distance(r.states[i], fine.states[i]).displacement,
              2.0 * tolerance);
  }
}

TEST(StepControl, TakesTheFewestStepsForTheSumOfTheirErrors) {
  // A step of h errs by C h^3, for a moment a million times more.
  const double fast = 0.05;
  const auto rate = [&](double t) { return t < fast ? 1e6 : 1.0; };
  StepControl control(ErrorBudget::each(1e-9), 1.0);
  control.begin(1e-4);
  const SystemState no_bodies;
  double t = 0.0;
  double errors = 0.0;
  int steps = 0;
  while (t < 1.0) {
    const double h = control.propose(no_bodies, 1.0 - t);
    const double error = rate(t) * h * h * h;
    if (!control.accepts(h, error)) continue;
    EXPECT_LE(error, 1e-9);
    errors += error;
    t += h;
    ++steps;
  }
  // The sum is int C h^2 dt and the number int dt / h, least for equal C h^3.
  const double fewest =
      std::pow(100.0 * fast + 1.0 - fast, 1.5) / std::sqrt(errors);
  EXPECT_GT(steps, 0.98 * fewest);
  EXPECT_LT(steps, 1.1 * fewest);
}

TEST(Interpolation, IsOfFourthOrderOnTheGroupAndThirdInTheVelocities) {
  SystemBuilder builder;
  builder.add_rigid_body("b", {1.0, Matrix3::Identity()});
  const SystemModel model = builder.build();
  // R(t) = exp(a(t)) with a smooth a, and its angular velocity.
  const auto angle = [](double t) {
    return Vector3(std::sin(t), 0.5 * t * t, std::cos(2.0 * t));
  };
  const auto rate = [](double t) {
    return Vector3(std::cos(t), t, -2.0 * std::sin(2.0 * t));
  };
  const auto at = [&](double t) {
    SystemState state = make_state(model);
    state.t = t;
    state.bodies[0].p_WB = angle(t);
    state.bodies[0].v_WB_W = rate(t);
    state.bodies[0].quat_WB = exp_quaternion(angle(t));
    state.bodies[0].w_WB_B = right_jacobian(angle(t)) * rate(t);
    return state;
  };
  struct Errors {
    double position, rotation, velocity, spin;
  };
  const auto measure = [&](double h) {
    SystemState got = make_state(model);
    Errors largest{};
    for (const double s : {0.2, 0.5, 0.7}) {
      interpolate(model, at(0.3), at(0.3 + h), s, got);
      const SystemState exact = at(0.3 + s * h);
      EXPECT_NEAR(got.t, exact.t, 1e-15);
      const BodyState& a = got.bodies[0];
      const BodyState& b = exact.bodies[0];
      largest.position = std::max(largest.position, (a.p_WB - b.p_WB).norm());
      largest.rotation =
          std::max(largest.rotation, a.quat_WB.angularDistance(b.quat_WB));
      largest.velocity =
          std::max(largest.velocity, (a.v_WB_W - b.v_WB_W).norm());
      largest.spin = std::max(largest.spin, (a.w_WB_B - b.w_WB_B).norm());
    }
    return largest;
  };
  const Errors coarse = measure(0.1);
  const Errors fine = measure(0.05);
  EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.rotation / fine.rotation), 4.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.velocity / fine.velocity), 3.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.spin / fine.spin), 3.0, 0.3);
}

TEST(MotionScale, IsTheDistanceOfTheFarthestPoint) {
  SystemBuilder builder;
  const auto b = builder.add_rigid_body("rod", {1.0, Matrix3::Identity()});
  builder.attach_frame("tip", b, {Matrix3::Identity(), {0.0, 0.0, 3.0}});
  const SystemModel model = builder.build();
  const MotionScale scale(model);
  const SystemState a = make_state(model);
  SystemState c = a;
  c.bodies[0].p_WB.x() = 0.5;
  EXPECT_DOUBLE_EQ(scale.measure_distance(a, c).displacement, 0.5);
  c = a;
  c.bodies[0].quat_WB = exp_quaternion({0.0, 1e-4, 0.0});
  EXPECT_NEAR(scale.measure_distance(a, c).displacement, 3e-4, 1e-12);
}

}  // namespace
}  // namespace limber::dynamics::tolerance_test
