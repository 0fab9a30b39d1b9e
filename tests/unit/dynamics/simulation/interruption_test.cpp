// SPDX-License-Identifier: BSD-3-Clause
// Runs that are interrupted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"
#include "support/sliding_masses.hpp"

namespace limber::dynamics::interruption_test {
namespace {

using ::testing::HasSubstr;

struct Scene {
  SystemModel model;
  SystemState state;
};

Scene make_scene() {
  testing::Chain chain =
      testing::make_chain({.bodies = 2,
                           .modes = 2,
                           .stiffness = 1e5,
                           .damping = 10.0,
                           .joint = joints::JointKind::revolute});
  chain.builder.set_gravity({0.0, 0.0, -9.81});
  return {chain.builder.build(), chain.state};
}

SimulationSettings make_settings(
    double tolerance = 0.0,
    TolerancePasses passes = TolerancePasses::verified) {
  SimulationSettings settings;
  settings.end_time = 0.2;
  settings.step = 1e-4;
  settings.tolerance = tolerance;
  settings.passes = passes;
  settings.output_times = {0.0, 0.1, 0.2};
  return settings;
}

struct End {
  SystemState state;
  SimulationStatistics statistics;
  std::size_t outputs = 0;
  std::string words;  // of Interrupted
};

End run(const Scene& scene, const SimulationSettings& settings,
        const Continuation& continuation, const Progress& progress = {}) {
  End end{scene.state, {}, 0, ""};
  const auto count = [&](const SystemState&, const EnergyBalance&) {
    ++end.outputs;
  };
  try {
    simulate(scene.model, end.state, settings, count, progress, end.statistics,
             continuation);
  } catch (const Interrupted& stop) {
    end.words = stop.what();
  }
  return end;
}

// A run's own checkpoints are an age apart.
Continuation keep_in(std::optional<Checkpoint>& kept) {
  Continuation continuation;
  continuation.keeper.interval = 1e9;
  continuation.keeper.keep = [&](const Checkpoint& c) { kept = c; };
  return continuation;
}

Progress ask_after(double share) {
  return [share](std::string_view, double fraction) {
    if (fraction >= share && fraction < 1.0) throw Interrupted("asked to end");
  };
}

void expect_same_end(const Scene& scene, const SimulationSettings& settings) {
  const End whole = run(scene, settings, {});
  ASSERT_EQ(whole.words, "");
  for (const double share : {0.0, 0.1, 0.6}) {
    std::optional<Checkpoint> kept;
    const End stopped = run(scene, settings, keep_in(kept), ask_after(share));
    EXPECT_THAT(stopped.words, HasSubstr("asked to end at t = "));
    ASSERT_TRUE(kept.has_value());
    EXPECT_LE(kept->time, stopped.state.t);
    Continuation rest;
    rest.from = kept;
    const End resumed = run(scene, settings, rest);
    EXPECT_EQ(resumed.words, "");
    EXPECT_EQ(resumed.state.eta, whole.state.eta);
    EXPECT_EQ(resumed.state.bodies[1].p_WB, whole.state.bodies[1].p_WB);
    EXPECT_EQ(resumed.statistics.steps, whole.statistics.steps);
  }
}

TEST(Interruption, KeepsACheckpointThatGoesOnToTheBit) {
  expect_same_end(make_scene(), make_settings());
}

TEST(Interruption, OfPassesToAToleranceDoesToo) {
  expect_same_end(make_scene(), make_settings(1e-6));
  expect_same_end(make_scene(), make_settings(1e-6, TolerancePasses::one));
}

// Several passes have outputs in their last alone.
TEST(Interruption, OfTheOnlyPassToAToleranceKeepsItsOutputs) {
  std::optional<Checkpoint> kept;
  const End stopped =
      run(make_scene(), make_settings(1e-6, TolerancePasses::one),
          keep_in(kept), ask_after(0.6));
  EXPECT_THAT(stopped.words, HasSubstr("asked to end at t = "));
  EXPECT_EQ(stopped.outputs, 2U);
}

TEST(Interruption, KeepsWhatWasComputed) {
  std::optional<Checkpoint> kept;
  const End stopped =
      run(make_scene(), make_settings(), keep_in(kept), ask_after(0.55));
  EXPECT_EQ(stopped.outputs, 2U);  // those of 0 and 0.1 s
  EXPECT_GT(stopped.statistics.steps, 1000);
  EXPECT_LT(stopped.state.t, 0.2);
}

TEST(Interruption, EndsAfterTheCurrentStep) {
  std::optional<Checkpoint> kept;
  const Progress at_once = [](std::string_view, double) {
    throw Interrupted("asked to end");
  };
  const End stopped =
      run(make_scene(), make_settings(), keep_in(kept), at_once);
  EXPECT_EQ(stopped.statistics.steps, 1);
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->time, 0.0);
  EXPECT_EQ(kept->outputs, 0U);
}

// Masses that reach soft stops one after the other, 20 in one step.
Scene make_crowded_step() {
  SystemBuilder builder;
  for (int i = 0; i < 20; ++i) {
    const testing::Mass mass =
        testing::add_mass(builder, fmt::format("mass_{}", i), 1.0);
    const joints::EndStop stop({.upper = 0.02 * (i + 1), .stiffness = 1.0});
    testing::add_rail(builder, mass, fmt::format("rail_{}", i), {{0, stop}});
  }
  Scene out{builder.build(), {}};
  out.state = make_state(out.model);
  for (BodyState& body : out.state.bodies) body.v_WB_W.x() = 1.0;
  return out;
}

TEST(Interruption, EndsWithinAStepOfManyEvents) {
  int calls = 0;
  const Progress slow = [&](std::string_view, double) {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    throw Interrupted("asked to end");
  };
  SimulationSettings settings;
  settings.end_time = settings.step = 0.5;
  settings.output_times = {0.0, 0.5};
  const End stopped = run(make_crowded_step(), settings, {}, slow);
  EXPECT_THAT(stopped.words, HasSubstr("asked to end at t = "));
  EXPECT_GT(calls, 2);
  EXPECT_LT(calls, 15);
  EXPECT_GT(stopped.state.t, 0.0);
  EXPECT_LT(stopped.state.t, 0.4);
  EXPECT_EQ(stopped.outputs, 1U);
}

TEST(Interruption, AfterTheLastStepIsNone) {
  std::optional<Checkpoint> kept;
  const End end =
      run(make_scene(), make_settings(), keep_in(kept), ask_after(0.99999));
  EXPECT_EQ(end.words, "");
  EXPECT_FALSE(kept.has_value());
}

}  // namespace
}  // namespace limber::dynamics::interruption_test
