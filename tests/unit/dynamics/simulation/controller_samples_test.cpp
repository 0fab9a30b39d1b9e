// SPDX-License-Identifier: BSD-3-Clause
// When controllers are sampled, and that runs repeat it.
#include <gtest/gtest.h>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "limber/joints/scalar/end_stop.hpp"
#include "support/sliding_masses.hpp"
#include "unit/dynamics/simulation/sampled_mass.hpp"

namespace limber::dynamics::controller_samples_test {
namespace {

using testing::add_rail;
using testing::Sampled;

std::vector<double> to_numbers(SystemState state) {
  Archive archive;
  archive(state);
  return archive.numbers();
}

TEST_F(Sampled, AtProductsOfThePeriodWhateverTheStep) {
  ControllerModel controller = make(0.1, note(-1.0));
  controller.offset = 0.03;
  builder_.add_controller(controller);
  const SystemModel model = builder_.build();
  for (const double step : {0.1, 0.007, 1.0 / 3.0}) {
    samples_.clear();
    SystemState state = make_state(model);
    simulate(model, state, {.end_time = 50.0, .step = step}, {});
    expect_each_once(0, 500, 0.03, 0.1);
    EXPECT_EQ(state.controllers[0].next, 500);
  }
}

TEST_F(Sampled, AtTheStartAndAtTheEndAndNotTwiceWhereRunsMeet) {
  builder_.add_controller(make(0.125, note(-1.0)));
  const SystemModel model = builder_.build();
  SystemState whole = make_state(model);
  simulate(model, whole, {.end_time = 2.0, .step = 0.125}, {});
  expect_each_once(0, 17, 0.0, 0.125);
  samples_.clear();
  SystemState parts = make_state(model);
  simulate(model, parts, {.end_time = 1.0, .step = 0.125}, {});
  simulate(model, parts, {.end_time = 2.0, .step = 0.125}, {});
  expect_each_once(0, 17, 0.0, 0.125);
  EXPECT_NEAR(parts.bodies[0].p_WB.x(), whole.bodies[0].p_WB.x(), 1e-13);
}

TEST_F(Sampled, FromALaterStartOnWithoutThoseBefore) {
  builder_.add_controller(make(0.25, note(-1.0)));
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  state.t = 0.6;
  simulate(model, state, {.end_time = 2.1, .step = 0.1}, {});
  expect_each_once(3, 6, 0.0, 0.25);
}

TEST_F(Sampled, OnceWhereStepsAreCutByEvents) {
  joints::EndStop::Parameters stop;
  stop.lower = -0.01;
  stop.upper = 0.01;
  stop.stiffness = 1e4;
  add_rail(builder_, mass_, "rail", {{0, joints::EndStop(stop)}});
  builder_.add_controller(make(0.01, note(-1.0)));
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  state.bodies[0].v_WB_W.x() = 1.0;
  const SimulationStatistics statistics =
      simulate(model, state, {.end_time = 0.5, .step = 0.01}, {});
  EXPECT_GT(statistics.events.size(), 10U);
  expect_each_once(0, 51, 0.0, 0.01);
}

TEST_F(Sampled, OnceAPassOfStepsToATolerance) {
  builder_.add_coupler(
      "spring",
      joints::Bushing({.translational_stiffness = 5e3 * Matrix3::Identity()}),
      builder_.attach_world("wall", {}), mass_.frame);
  ControllerModel controller = make(0.02, note(-900.0));
  builder_.add_controller(controller);
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB.x() = 0.1;
  const SystemState start = state;
  const SimulationSettings settings{.end_time = 0.4,
                                    .step = 0.4,
                                    .tolerance = 1e-5,
                                    .passes = TolerancePasses::verified,
                                    .output_times = {0.1, 0.25, 0.4}};
  const testing::RunOutcome run = testing::run_from(model, start, settings);
  EXPECT_GT(run.statistics.rejected_steps, 0);
  ASSERT_EQ(std::ssize(samples_), 21 * run.statistics.passes);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    EXPECT_EQ(samples_[i].number, static_cast<long>(i % 21));
  }
  // The samples of a fine run, at the same times.
  const testing::RunOutcome fine = testing::run_from(
      model, start,
      {.end_time = 0.4, .step = 1e-4, .output_times = {0.1, 0.25, 0.4}});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(run.states[i].bodies[0].p_WB.x(),
                fine.states[i].bodies[0].p_WB.x(), 1e-5);
    EXPECT_EQ(run.states[i].controllers[0].next,
              fine.states[i].controllers[0].next);
    // An output on a sample shows what was written then.
    EXPECT_NEAR(run.states[i].inputs[0].value, fine.states[i].inputs[0].value,
                1e-2);
  }
  EXPECT_EQ(to_numbers(run.state),
            to_numbers(testing::run_from(model, start, settings).state));
}

TEST_F(Sampled, OnceWhereAStepIsHalved) {
  // A spring that is too much for so few iterations, except for short steps.
  joints::PointSpring::Parameters spring;
  spring.free_length = 0.02;
  spring.stiffness = 1e4;
  builder_.add_coupler("spring", joints::PointSpring(spring),
                       builder_.attach_world("wall", {}), mass_.frame);
  builder_.add_controller(make(0.02, note(-1.0)));
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  state.bodies[0].p_WB = Vector3(0.0, 0.03, 0.0);
  state.bodies[0].v_WB_W = Vector3(3.0, 0.0, 1.0);
  SimulationSettings settings{.end_time = 0.2, .step = 0.005};
  settings.newton_tolerance = 1e-10;
  settings.newton_iterations = 2;
  const SimulationStatistics statistics = simulate(model, state, settings, {});
  EXPECT_GT(statistics.halved_steps, 0);
  expect_each_once(0, 11, 0.0, 0.02);
}

TEST_F(Sampled, TogetherControllersSeeTheSameState) {
  const InputIndex second = builder_.add_input("second", 5.0);
  const auto relay = [](int from) {
    return [from](const ControllerView& view, std::span<double>,
                  std::span<double> written) {
      written[0] =
          view.state.inputs[static_cast<std::size_t>(from)].value + 1.0;
    };
  };
  ControllerModel a = make(0.1, relay(second));
  ControllerModel b = make(0.1, relay(input_));
  b.name = "b";
  b.writes = {second};
  builder_.add_controller(a);
  builder_.add_controller(b);
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  simulate(model, state, {.end_time = 0.05, .step = 0.05}, {});
  EXPECT_EQ(state.inputs[0].value, 6.0);
  EXPECT_EQ(state.inputs[1].value, 1.0);
}

TEST_F(Sampled, ARunGoesOnFromSaveToTheBit) {
  // Own memory: an integrator.
  ControllerModel controller =
      make(0.0125, [](const ControllerView& view, std::span<double> memory,
                      std::span<double> written) {
        memory[0] += 0.0125 * view.measured[0];
        written[0] = -20.0 * view.measured[0] - 9.0 * memory[0];
      });
  controller.memory = {0.1};
  builder_.add_controller(controller);
  const SystemModel model = builder_.build();
  SystemState start = make_state(model);
  start.bodies[0].p_WB.x() = 0.5;
  const SimulationSettings settings{.end_time = 1.0, .step = 0.005};
  Simulator whole(model, start, settings);
  whole.advance_to(0.4);
  const Checkpoint checkpoint = whole.save();
  whole.advance_to(1.0);
  Simulator rest(model, start, settings);
  rest.restore(checkpoint);
  rest.advance_to(1.0);
  EXPECT_EQ(to_numbers(rest.state()), to_numbers(whole.state()));
  EXPECT_NE(whole.state().controllers[0].memory[0], 0.1);
}

TEST_F(Sampled, ARunGoesOnFromAnyCheckpointToTheBit) {
  ControllerModel controller =
      make(0.0007, [](const ControllerView& view, std::span<double> memory,
                      std::span<double> written) {
        memory[0] += view.measured[0];
        written[0] = -20.0 * view.measured[0] - 0.01 * memory[0];
      });
  controller.memory = {0.0};
  builder_.add_controller(controller);
  builder_.add_coupler(
      "spring",
      joints::Bushing({.translational_stiffness = 5e3 * Matrix3::Identity()}),
      builder_.attach_world("wall", {}), mass_.frame);
  const SystemModel model = builder_.build();
  SystemState start = make_state(model);
  start.bodies[0].p_WB.x() = 0.1;
  for (const double tolerance : {0.0, 1e-6}) {
    SimulationSettings settings{.end_time = 0.5,
                                .step = 0.0002,
                                .tolerance = tolerance,
                                .output_times = {0.25, 0.5}};
    std::vector<Checkpoint> kept;
    std::vector<double> log;
    Continuation continuation;
    continuation.keeper.interval = 0.0;
    continuation.keeper.keep = [&](const Checkpoint& c) {
      log.insert(log.end(), c.log.begin(), c.log.end());
      kept.push_back({c.time, c.numbers, log});
    };
    SystemState whole = start;
    SimulationStatistics statistics;
    simulate(model, whole, settings, {}, {}, statistics, continuation);
    ASSERT_GE(kept.size(), 4U);
    for (std::size_t i = 0; i < kept.size(); i += kept.size() / 3) {
      SystemState rest = start;
      SimulationStatistics more;
      Continuation from;
      from.from = kept[i];
      simulate(model, rest, settings, {}, {}, more, from);
      EXPECT_EQ(to_numbers(rest), to_numbers(whole));
      EXPECT_EQ(more.steps, statistics.steps);
    }
  }
}

}  // namespace
}  // namespace limber::dynamics::controller_samples_test
