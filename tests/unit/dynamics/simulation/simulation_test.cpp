// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limber/common/errors.hpp"
#include "support/chain.hpp"
#include "unit/dynamics/simulation/simulation_outcome.hpp"

namespace limber::dynamics::simulation_test {
namespace {

using test::Outcome;
using test::rigid_body;
using test::run;
using test::sample;
using test::stir;
using testing::Chain;
using testing::make_chain;

TEST(Simulation, OutputTimesAreMetExactly) {
  Chain chain = make_chain({.bodies = 2});
  const SystemModel model = chain.builder.build();
  const std::vector<double> times = {0.0, 0.0105, 0.02, 0.0333};
  const Outcome r =
      run(model, chain.state,
          {.end_time = 0.04, .step = 1e-3, .output_times = times});
  ASSERT_EQ(r.states.size(), times.size());
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(r.states[i].t, times[i]);
  }
  EXPECT_EQ(r.state.t, 0.04);
}

// A time of 1e6 s rounds to 1e-10 s, 1e-7 of the step.
TEST(Simulation, StepsBetweenOutputsAreAsManyLateAsEarly) {
  Chain chain = make_chain({.bodies = 1});
  const SystemModel model = chain.builder.build();
  for (const double start : {0.0, 1e3, 1e6}) {
    SystemState state = chain.state;
    state.t = start;
    const std::vector<double> times = {start + 0.012, start + 0.024,
                                       start + 0.036};
    const SimulationStatistics statistics = simulate(
        model, state,
        {.end_time = times.back(), .step = 1e-3, .output_times = times}, {});
    EXPECT_EQ(statistics.steps, 36) << "from " << start << " s";
  }
}

TEST(Simulation, AHalfSineShorterThanAStepGivesItsImpulse) {
  constexpr double kMass = 2.0;        // [kg]
  constexpr double kForce = 30.0;      // [N]
  constexpr double kDuration = 1e-4;   // [s]
  constexpr double kSixteenth = 4e-3;  // the trapezoidal rule's error is 0.3 %
  const double speed = 2.0 / std::numbers::pi * kForce * kDuration / kMass;
  for (const std::string& name : integrator_names()) {
    SystemBuilder builder;
    const auto body =
        builder.add_rigid_body("ball", {kMass, Matrix3::Identity()});
    const auto centre = builder.attach_frame("centre", body, {});
    builder.add_load("blow", centre, kForce * Vector3::UnitX(), Vector3::Zero(),
                     LoadFrame::world,
                     Pulse{PulseShape::half_sine, 0.002, kDuration});
    const SystemModel model = builder.build();
    for (const double step : {1e-3, 1.0}) {
      SystemState state = make_state(model);
      simulate(model, state,
               {.integrator = parse_integrator(name),
                .end_time = 1.0,
                .step = step,
                .output_times = {}},
               {});
      EXPECT_NEAR(state.bodies[0].v_WB_W[0] / speed, 1.0, kSixteenth)
          << name << ", steps of " << step << " s";
    }
  }
}

TEST(Simulation, SameRunTwiceIsTheSameToTheBit) {
  Chain chain = make_chain({.bodies = 4});
  stir(chain.state, 1.0, 1.0, 1.0);
  const SystemModel model = chain.builder.build();
  const SimulationSettings settings{
      .end_time = 0.1, .step = 1e-3, .output_times = {}};
  const Outcome a = run(model, chain.state, settings);
  const Outcome b = run(model, chain.state, settings);
  EXPECT_EQ(a.state.eta, b.state.eta);
  EXPECT_EQ(a.state.bodies[3].p_WB, b.state.bodies[3].p_WB);
}

TEST(Simulation, StepsChangeAtTheGivenTimes) {
  const SystemModel model = rigid_body(Matrix3::Identity());
  const Outcome r = run(model, make_state(model),
                        {.end_time = 1.0,
                         .step = 0.01,
                         .step_changes = {{0.1, 0.3}, {0.7, 0.05}},
                         .output_times = {}});
  EXPECT_EQ(r.statistics.steps, 10 + 2 + 6);
}

TEST(Simulation, UnevenStepsKeepTheSecondOrder) {
  // Torque-free asymmetric top; the reference takes steps of its own.
  const SystemModel model =
      rigid_body(Vector3(1.0, 2.0, 3.0).asDiagonal().toDenseMatrix());
  SystemState start = make_state(model);
  start.bodies[0].w_WB_B = Vector3(0.5, 1.0, 0.2);
  const Outcome reference = run(model, start,
                                {.integrator = IntegratorKind::runge_kutta_4,
                                 .end_time = 4.0,
                                 .step = 1e-3,
                                 .output_times = {}});
  std::vector<double> errors;
  for (const double h : {0.02, 0.01, 0.005}) {
    SimulationSettings settings = {
        .end_time = 4.0, .step = h, .output_times = {}};
    for (int i = 1; i < 40; ++i) {  // long and short in turn, a factor of five
      settings.step_changes.push_back({0.1 * i, i % 2 == 0 ? h : 0.2 * h});
    }
    const Outcome r = run(model, start, settings);
    errors.push_back(
        (r.state.bodies[0].w_WB_B - reference.state.bodies[0].w_WB_B).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.1);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.1);
}

TEST(Simulation, SettingsOutOfRangeAreRefused) {
  const SystemModel model = rigid_body(Matrix3::Identity());
  const auto refuse = [&](const SimulationSettings& settings) {
    SystemState state = make_state(model);
    EXPECT_THROW(simulate(model, state, settings, {}), InputError);
  };
  refuse({.end_time = 0.0, .step = 1e-3, .output_times = {}});
  refuse({.end_time = 1.0, .step = 0.0, .output_times = {}});
  refuse({.end_time = 1.0, .step = 0.1, .step_changes = {{0.5, -0.1}}});
  refuse(
      {.end_time = 1.0, .step = 0.1, .step_changes = {{0.5, 0.1}, {0.5, 0.2}}});
  refuse({.end_time = 1.0, .step = 1e-3, .output_times = {}, .rho_inf = 1.5});
}

// A double has 52 bits after the first: seconds since 1970 are 2.4e-7 s apart.
TEST(Simulation, StepsThatTimesCannotResolveAreRefused) {
  const SystemModel model = rigid_body(Matrix3::Identity());
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 1.0;
  state.t = 1.7e9;
  for (const double step : {1e-8, 1e-6, 1e-3}) {
    EXPECT_THROW(
        run(model, state,
            {.end_time = state.t + 1.0, .step = step, .output_times = {}}),
        InputError)
        << step;
  }
  EXPECT_THROW(run(model, state,
                   {.end_time = state.t + 1.0,
                    .step = 0.1,
                    .step_changes = {{state.t + 0.5, 1e-6}},
                    .output_times = {}}),
               InputError);
  const Outcome r =
      run(model, state,
          {.end_time = state.t + 100.0, .step = 0.1, .output_times = {}});
  EXPECT_NEAR(r.state.bodies[0].p_WB.x(), 100.0, 1e-6);
}

TEST(Simulation, BlowUpEndsWithTheBodyAndTheTimeAndKeepsTheLastGoodState) {
  Chain chain = make_chain({.bodies = 2, .stiffness = 1e16});
  stir(chain.state, 1.0, 1.0, 1.0);
  const SystemModel model = chain.builder.build();
  SystemState state = chain.state;
  int observed = 0;
  try {
    simulate(model, state,
             {.integrator = IntegratorKind::runge_kutta_4,
              .end_time = 10.0,
              .step = 0.01,
              .output_times = sample(10.0, 1000)},
             [&](const SystemState&, const EnergyBalance&) { ++observed; });
    FAIL() << "an unstable explicit step was called a success";
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("link"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("t = "), std::string::npos);
  }
  EXPECT_GT(observed, 0);
  EXPECT_TRUE(state.eta.allFinite());
}

TEST(Simulate, RefusesAStateFromBeforeItsModelGotAPath) {
  Chain chain = make_chain({.bodies = 2});
  chain.builder.add_path("rubbed",
                         {chain.last_interfaces[0], chain.last_interfaces[1]},
                         {joints::Friction({.coulomb = 0.5, .speed = 0.01})});
  const SystemModel model = chain.builder.build();
  SystemState state = chain.state;
  EXPECT_THROW(simulate(model, state, {.end_time = 0.1, .step = 0.01}, {}),
               ContractError);
}

}  // namespace
}  // namespace limber::dynamics::simulation_test
