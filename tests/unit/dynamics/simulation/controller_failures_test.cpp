// SPDX-License-Identifier: BSD-3-Clause
// What ends a run with controllers, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/simulation/simulator.hpp"
#include "limber/dynamics/system/model_fields.hpp"
#include "support/sliding_masses.hpp"
#include "unit/dynamics/simulation/sampled_mass.hpp"

namespace limber::dynamics::controller_failures_test {
namespace {

using joints::Drive;
using joints::DriveMode;
using joints::InputSignal;
using testing::add_mass;
using testing::add_rail;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Mass;
using testing::Sampled;
using ::testing::ThrowsMessage;
using Function = testing::Function;

// --- What ends a run --------------------------------------------------------

class Failing : public Sampled {
 protected:
  // What the run says; it must end at `t` with the state kept.
  std::string run(const ControllerModel& controller, double t) {
    builder_.add_controller(controller);
    const SystemModel model = builder_.build();
    SystemState state = make_state(model);
    state.bodies[0].v_WB_W.x() = 1.0;
    SimulationSettings settings{.end_time = 1.0, .step = 0.03};
    settings.output_times = {0.1, 0.25, 0.35, 0.9};
    int outputs = 0;
    try {
      simulate(model, state, settings,
               [&](const SystemState&, const EnergyBalance&) { ++outputs; });
    } catch (const NumericalError& error) {
      EXPECT_EQ(state.t, t);
      EXPECT_EQ(state.controllers[0].next, std::lround(t / 0.1));
      EXPECT_EQ(outputs, t < 0.1 ? 0 : 2);
      EXPECT_GE(state.bodies[0].p_WB.x(), t - 1e-12);
      return error.what();
    }
    ADD_FAILURE() << "it went through";
    return {};
  }

  static Function fail_at(long sample, const std::function<double()>& value) {
    return [=](const ControllerView& view, std::span<double>,
               std::span<double> written) {
      written[0] = view.sample == sample ? value() : 1.0;
    };
  }
};

TEST_F(Failing, AControllerThatThrowsEndsTheRunByName) {
  const std::string text = run(
      make(0.1,
           fail_at(3, []() -> double { throw std::range_error("no sun"); })),
      3 * 0.1);
  EXPECT_THAT(text, HasSubstr("controller 'controller' at t = 0.3 s: no sun"));
}

TEST_F(Failing, AControllerThatThrowsAtTheStartEndsTheRunThere) {
  const std::string text =
      run(make(0.1, fail_at(0, []() -> double { throw 3; })), 0.0);
  EXPECT_THAT(text, HasSubstr("controller 'controller' at t = 0 s"));
}

TEST_F(Failing, AnInputThatIsNotFiniteEndsTheRunByName) {
  const std::string text = run(
      make(0.1,
           fail_at(3, [] { return std::numeric_limits<double>::infinity(); })),
      3 * 0.1);
  EXPECT_THAT(text, HasSubstr("controller 'controller' at t = 0.3 s: input "
                              "'push' is inf after sample 3"));
}

TEST_F(Failing, AnInputThatIsNotWrittenEndsTheRun) {
  const std::string text = run(
      make(0.1,
           [](const ControllerView&, std::span<double>, std::span<double>) {}),
      0.0);
  EXPECT_THAT(text, HasSubstr("input 'push' is nan after sample 0"));
}

TEST_F(Failing, AMeasurementOrMemoryThatIsNotFiniteEndsTheRunByName) {
  ControllerModel controller = make(0.1, note(1.0));
  controller.measures.push_back(
      {"sky", "", [](const SystemModel&, const SystemState& state) {
         return state.t > 0.25 ? std::sqrt(-1.0) : 0.0;
       }});
  EXPECT_THAT(run(controller, 3 * 0.1), HasSubstr("'sky', which it measures"));
}

TEST_F(Failing, MemoryThatIsNotFiniteEndsTheRunByName) {
  ControllerModel controller =
      make(0.1, [](const ControllerView& view, std::span<double> memory,
                   std::span<double> written) {
        written[0] = 0.0;
        if (view.sample == 3) memory[1] = std::log(-1.0);
      });
  controller.memory = {0.0, 0.0};
  EXPECT_THAT(run(controller, 3 * 0.1), HasSubstr("number 2 of its memory"));
}

// --- What is refused --------------------------------------------------------

TEST_F(Sampled, HiddenMemoryIsRefusedWhereARunMustBeRepeated) {
  builder_.add_controller(
      make(0.1, note(1.0), FunctionController::Memory::hidden));
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  SimulationSettings settings{.end_time = 1.0, .step = 0.1};
  SimulationStatistics statistics;
  Continuation continuation;
  continuation.keeper.keep = [](const Checkpoint&) {};
  EXPECT_THROW(
      simulate(model, state, settings, {}, {}, statistics, continuation),
      InputError);
  Simulator simulator(model, state, settings);
  simulator.advance_to(0.5);
  EXPECT_THROW((void)simulator.save(), InputError);
  const auto run_again = [&] {
    SystemState start = make_state(model);
    simulate(model, start, settings, {});
  };
  EXPECT_NO_THROW(run_again());
  settings.tolerance = 1e-6;
  EXPECT_NO_THROW(run_again());
  settings.passes = TolerancePasses::verified;
  EXPECT_THAT(run_again,
              ThrowsMessage<InputError>(HasSubstr("needs several passes")));
}

TEST_F(Sampled, BadControllersAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect_refused = [&](const auto& change, const char* text) {
    ControllerModel controller = make(0.1, note(1.0));
    change(controller);
    try {
      builder_.add_controller(controller);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(text));
    }
  };
  for (const double period : {0.0, -1.0, nan, kNever}) {
    expect_refused([&](ControllerModel& c) { c.period = period; },
                   "its period is");
  }
  expect_refused([&](ControllerModel& c) { c.offset = nan; }, "its offset");
  expect_refused([&](ControllerModel& c) { c.writes = {}; }, "no input");
  expect_refused([&](ControllerModel& c) { c.writes = {0, 0}; }, "twice");
  expect_refused([&](ControllerModel& c) { c.memory = {nan}; }, "memory");
  expect_refused([&](ControllerModel& c) { c.name = ""; }, "controller");
  expect_refused(
      [&](ControllerModel& c) { c.measures.push_back(c.measures[0]); },
      "measures 'x' twice");
  ControllerModel wrong = make(0.1, note(1.0));
  wrong.writes = {1};
  EXPECT_THROW(builder_.add_controller(wrong), ContractError);
  wrong = make(0.1, note(1.0));
  wrong.law = nullptr;
  EXPECT_THROW(builder_.add_controller(wrong), ContractError);
  EXPECT_THROW(builder_.add_input("push", 0.0), InputError);
  EXPECT_THROW(builder_.add_input("other", nan), InputError);
  builder_.add_controller(make(0.1, note(1.0)));
  expect_refused([](ControllerModel&) {}, "controller");
  expect_refused([](ControllerModel& c) { c.name = "second"; },
                 "which controller 'controller' also writes");
}

TEST_F(Sampled, InputsThatAreNotThereAreRefused) {
  EXPECT_THROW(
      builder_.add_load("two", mass_.frame, Vector3::UnitX(), Vector3::Zero(),
                        LoadFrame::world, InputFunction{1, 1.0}),
      ContractError);
  EXPECT_THROW(
      builder_.add_load("two", mass_.frame, Vector3::UnitX(), Vector3::Zero(),
                        LoadFrame::world, InputFunction{0, kNever}),
      InputError);
  EXPECT_THROW(add_rail(builder_, mass_, "rail",
                        {{0, Drive({.mode = DriveMode::effort,
                                    .signal = {InputSignal{1, 1.0}}})}}),
               ContractError);
}

TEST_F(Sampled, TooManySamplesAndStatesOfLaterRunsAreRefused) {
  builder_.add_controller(make(1e-9, note(1.0)));
  const SystemModel model = builder_.build();
  SystemState state = make_state(model);
  EXPECT_THROW(simulate(model, state, {.end_time = 1.0, .step = 0.1}, {}),
               InputError);
  state.controllers[0].next = 2;
  EXPECT_THROW(simulate(model, state, {.end_time = 1e-8, .step = 1e-9}, {}),
               InputError);
  state.controllers.clear();
  EXPECT_THROW(simulate(model, state, {.end_time = 1.0, .step = 0.1}, {}),
               ContractError);
}

TEST_F(Sampled, TheFingerprintTellsEveryChange) {
  const auto describe_model = [](const SystemBuilder& builder) {
    Manifest manifest;
    describe(manifest, "system", builder.build());
    return manifest;
  };
  const auto add = [&](const auto& change) {
    SystemBuilder builder = builder_;
    ControllerModel controller = make(0.1, note(1.0));
    change(controller);
    builder.add_controller(controller);
    return describe_model(builder);
  };
  const Manifest before = add([](ControllerModel&) {});
  const auto differences = [&](const auto& change) {
    return find_differences(before, add(change));
  };
  EXPECT_TRUE(differences([](ControllerModel&) {}).empty());
  EXPECT_THAT(differences([](ControllerModel& c) { c.period = 0.2; }),
              ElementsAre("system, controller 'controller', period: 0.1 -> "
                          "0.2 s"));
  EXPECT_EQ(differences([](ControllerModel& c) { c.offset = 0.2; }).size(), 1U);
  EXPECT_EQ(differences([](ControllerModel& c) { c.memory = {0.2}; }).size(),
            1U);
  EXPECT_EQ(
      differences([](ControllerModel& c) { c.measures[0].of = "y"; }).size(),
      1U);
  EXPECT_EQ(differences([](ControllerModel& c) {
              c.law = std::make_shared<FunctionController>(
                  "another", [](const ControllerView&, std::span<double>,
                                std::span<double>) {});
            }).size(),
            1U);
  EXPECT_FALSE(
      differences([](ControllerModel& c) { c.name = "other"; }).empty());
  SystemBuilder other;
  const Mass mass = add_mass(other, "mass", 2.0);
  other.add_input("push", 0.0, InputHold::linear);
  other.add_load("push", mass.frame, Vector3::UnitX(), Vector3::Zero(),
                 LoadFrame::world, InputFunction{0, 2.0});
  EXPECT_EQ(
      find_differences(describe_model(builder_), describe_model(other)).size(),
      2U);
}

}  // namespace
}  // namespace limber::dynamics::controller_failures_test
