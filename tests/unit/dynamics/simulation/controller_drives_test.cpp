// SPDX-License-Identifier: BSD-3-Clause
// What drives make of the inputs that controllers write.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/sliding_masses.hpp"
#include "unit/dynamics/simulation/sampled_mass.hpp"

namespace limber::dynamics::controller_drives_test {
namespace {

using joints::Drive;
using joints::DriveMode;
using joints::InputSignal;
using testing::add_mass;
using testing::add_rail;
using testing::Mass;

// A position drive's spring is set anew at a sample: k ((x - s1)^2 - (x -
// s0)^2) / 2 is the drive's work, and all of it.
TEST(InputsOfDrives, TheWorkOfAPositionDriveThatJumpsIsCounted) {
  for (const InputHold hold : {InputHold::held, InputHold::linear}) {
    SystemBuilder builder;
    const Mass mass = add_mass(builder, "mass", 2.0);
    const InputIndex target = builder.add_input("target", 0.0, hold);
    add_rail(builder, mass, "rail",
             {{0, Drive({.mode = DriveMode::position,
                         .signal = {InputSignal{target, 0.5}},
                         .stiffness = 300.0})}});
    builder.add_controller(
        {.name = "script",
         .period = 0.05,
         .writes = {target},
         .law = std::make_shared<FunctionController>(
             "script", [](const ControllerView& view, std::span<double>,
                          std::span<double> written) {
               written[0] = std::sin(1.7 * static_cast<double>(view.sample));
             })});
    const SystemModel model = builder.build();
    SystemState state = make_state(model);
    SimulationSettings settings{.integrator = IntegratorKind::energy_conserving,
                                .end_time = 1.0,
                                .step = 0.005};
    for (int i = 0; i <= 100; ++i) settings.output_times.push_back(0.01 * i);
    double scale = 0.0;
    double largest = 0.0;
    SimulationStatistics statistics;
    RunRecord record;
    simulate(
        model, state, settings,
        [&](const SystemState& /*now*/, const EnergyBalance& energy) {
          scale = std::max(scale, energy.total());
          largest = std::max(largest, std::abs(energy.total() - energy.work +
                                               energy.dissipated));
        },
        {}, statistics, {}, {}, record);
    EXPECT_GT(scale, 1.0);
    EXPECT_LT(largest, 1e-11 * scale);
    EXPECT_LT(std::abs(record.energy.drift.value), 1e-11 * scale);
    EXPECT_TRUE(statistics.warnings.empty());
  }
}

// The same command as a table, known before.
TEST(InputsOfDrives, APositionDriveFollowsALinearInputAsItDoesATable) {
  constexpr double T = 0.04;
  const auto script = [](double k) { return std::sin(1.7 * k); };
  const auto make = [&](const joints::Signal& signal) {
    SystemBuilder builder;
    const Mass mass = add_mass(builder, "mass", 2.0);
    builder.add_input("target", 0.0, InputHold::linear);
    add_rail(builder, mass, "rail",
             {{0, Drive({.mode = DriveMode::position,
                         .signal = signal,
                         .stiffness = 300.0,
                         .damping = 9.0})}});
    builder.add_controller(
        {.name = "script",
         .period = T,
         .writes = {0},
         .law = std::make_shared<FunctionController>(
             "script", [script](const ControllerView& view, std::span<double>,
                                std::span<double> written) {
               written[0] = script(static_cast<double>(view.sample));
             })});
    return builder.build();
  };
  joints::TableSignal table{{0.0}, {0.0}};
  for (int k = 0; k < 25; ++k) {
    table.times.push_back((k + 1) * T);
    table.values.push_back(script(k));
  }
  for (const IntegratorKind kind :
       {IntegratorKind::generalized_alpha, IntegratorKind::energy_conserving,
        IntegratorKind::implicit_euler}) {
    const SimulationSettings settings{
        .integrator = kind, .end_time = 0.9, .step = 0.002};
    const SystemModel with_input = make({InputSignal{0, 1.0}});
    const SystemModel with_table = make({table});
    SystemState a = make_state(with_input);
    SystemState b = make_state(with_table);
    const auto first = simulate(with_input, a, settings, {});
    const auto second = simulate(with_table, b, settings, {});
    EXPECT_NEAR(a.bodies[0].p_WB.x(), b.bodies[0].p_WB.x(), 1e-9);
    EXPECT_GT(std::abs(a.bodies[0].p_WB.x()), 0.01);
    EXPECT_EQ(first.steps, second.steps);
  }
}

TEST(InputsOfDrives, AVelocityDriveIsHeldToItsLimit) {
  const Drive drive({.mode = DriveMode::velocity,
                     .signal = {InputSignal{0, 2.0}},
                     .damping = 10.0,
                     .max_speed = 3.0});
  const std::vector<InputState> fast = {{.value = -40.0}};
  const std::vector<InputState> slow = {{.value = 1.0}};
  EXPECT_EQ(drive.find_target_rate({1.0, Side::right, fast}), -3.0);
  EXPECT_EQ(drive.find_target_rate({1.0, Side::right, slow}), 2.0);
  EXPECT_THROW((void)drive.find_target_rate({1.0}), ContractError);
}

TEST(InputsOfDrives, WhatCannotBeHeldIsRefused) {
  EXPECT_THROW(Drive({.mode = DriveMode::position,
                      .signal = {InputSignal{0, 1.0}},
                      .stiffness = 10.0,
                      .max_speed = 3.0}),
               InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(
      Drive({.mode = DriveMode::effort, .signal = {InputSignal{0, nan}}}),
      InputError);
  EXPECT_THROW(
      Drive({.mode = DriveMode::effort,
             .signal = {InputSignal{0, 1.0}, {{0.5, 0.0}, {0.5, 0.1}}}}),
      InputError);
  EXPECT_THROW(Drive({.mode = DriveMode::effort,
                      .signal = {InputSignal{0, 1.0}, {{1.0, 0.1}}}}),
               InputError);
  EXPECT_THROW((void)evaluate(InputFunction{0, 1.0}, 0.0, Side::right),
               ContractError);
}

}  // namespace
}  // namespace limber::dynamics::controller_drives_test
