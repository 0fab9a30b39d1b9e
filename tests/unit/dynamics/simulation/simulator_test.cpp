// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/simulation/simulator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stop_token>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "support/chain.hpp"

namespace limber::dynamics::simulator_test {
namespace {

using ::testing::HasSubstr;

void expect_same(const SystemState& a, const SystemState& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.eta, b.eta);
  EXPECT_EQ(a.etadot, b.etadot);
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    EXPECT_EQ(a.bodies[i].p_WB, b.bodies[i].p_WB);
    EXPECT_EQ(a.bodies[i].quat_WB.coeffs(), b.bodies[i].quat_WB.coeffs());
    EXPECT_EQ(a.bodies[i].v_WB_W, b.bodies[i].v_WB_W);
    EXPECT_EQ(a.bodies[i].w_WB_B, b.bodies[i].w_WB_B);
  }
}

double find_distance(const SystemState& a, const SystemState& b) {
  double squared = (a.eta - b.eta).squaredNorm();
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    squared += (a.bodies[i].p_WB - b.bodies[i].p_WB).squaredNorm();
  }
  return std::sqrt(squared);
}

/// A hinged chain that falls and is struck from 0.05 s to 0.07 s.
class SimulatorOfAStruckChain : public ::testing::Test {
 protected:
  SimulatorOfAStruckChain() {
    const testing::Chain chain = testing::make_loaded_chain(
        2e3, 2.0, Pulse{.start = 0.05, .duration = 0.02});
    model_ = chain.builder.build();
    start_ = chain.state;
  }

  SystemModel model_;
  SystemState start_;
  SimulationSettings settings_{.end_time = 0.2, .step = 1e-3};
};

TEST_F(SimulatorOfAStruckChain, IsSimulateToTheBitAtItsOutputs) {
  settings_.output_times = {0.0203, 0.05, 0.1234, 0.2};
  std::vector<SystemState> seen;
  std::vector<EnergyBalance> energies;
  SystemState state = start_;
  simulate(model_, state, settings_,
           [&](const SystemState& now, const EnergyBalance& energy) {
             seen.push_back(now);
             energies.push_back(energy);
           });
  Simulator simulator(model_, start_, settings_);
  for (std::size_t i = 0; i < settings_.output_times.size(); ++i) {
    EXPECT_TRUE(simulator.advance_to(settings_.output_times[i]));
    expect_same(simulator.state(), seen[i]);
    EXPECT_EQ(simulator.calc_energy().total(), energies[i].total());
    EXPECT_EQ(simulator.calc_energy().work, energies[i].work);
  }
}

TEST_F(SimulatorOfAStruckChain, EndsAStepWhereverItIsAskedTo) {
  const std::vector<double> times = {0.0001,  0.00312, 0.0499999, 0.06,
                                     0.06001, 0.13579, 0.2};
  std::vector<double> errors;
  settings_.step = 1e-4;
  Simulator reference(model_, start_, settings_);
  reference.advance_to(0.2);
  for (const double step : {2e-3, 1e-3}) {
    settings_.step = step;
    Simulator simulator(model_, start_, settings_);
    for (const double t : times) {
      EXPECT_TRUE(simulator.advance_to(t));
      EXPECT_EQ(simulator.state().t, t);
    }
    errors.push_back(find_distance(simulator.state(), reference.state()));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.3);
}

TEST_F(SimulatorOfAStruckChain, TakesStepsToATolerance) {
  SimulationSettings fine = settings_;
  fine.step = 2e-5;
  Simulator reference(model_, start_, fine);
  reference.advance_to(0.2);
  settings_.step = 0.02;
  settings_.tolerance = 1e-8;
  Simulator simulator(model_, start_, settings_);
  for (const double t : {0.013, 0.0666, 0.2}) {
    EXPECT_TRUE(simulator.advance_to(t));
    EXPECT_EQ(simulator.state().t, t);
  }
  EXPECT_LT(find_distance(simulator.state(), reference.state()), 1e-5);
}

TEST_F(SimulatorOfAStruckChain, EndsWhenItIsAskedToAndGoesOn) {
  Simulator whole(model_, start_, settings_);
  whole.advance_to(0.2);
  Simulator simulator(model_, start_, settings_);
  std::stop_source source;
  source.request_stop();
  EXPECT_FALSE(simulator.advance_to(0.2, source.get_token()));
  EXPECT_FALSE(simulator.advance_to(0.0707, source.get_token()));
  expect_same(simulator.state(), start_);
  EXPECT_TRUE(simulator.advance_to(0.2));
  expect_same(simulator.state(), whole.state());
}

TEST_F(SimulatorOfAStruckChain, GoesOnFromWhatItSavedToTheBit) {
  for (const double tolerance : {0.0, 1e-7}) {
    settings_.tolerance = tolerance;
    Simulator simulator(model_, start_, settings_);
    simulator.advance_to(0.0611);
    const Checkpoint saved = simulator.save();
    simulator.advance_to(0.0712);
    simulator.advance_to(0.2);
    Simulator other(model_, start_, settings_);
    other.restore(saved);
    EXPECT_EQ(other.state().t, 0.0611);
    other.advance_to(0.0712);
    other.advance_to(0.2);
    expect_same(other.state(), simulator.state());
    EXPECT_EQ(other.statistics().steps, simulator.statistics().steps);
    EXPECT_EQ(other.calc_energy().dissipated,
              simulator.calc_energy().dissipated);
  }
}

TEST_F(SimulatorOfAStruckChain, RefusesTimesOutsideOfItsSpan) {
  Simulator simulator(model_, start_, settings_);
  simulator.advance_to(0.1);
  for (const double t : {0.0999, 0.2001, std::nan("")}) {
    try {
      simulator.advance_to(t);
      FAIL() << t;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("from 0.1 s"));
      EXPECT_THAT(error.what(), HasSubstr("0.2 s, the settings' end"));
    }
  }
  EXPECT_EQ(simulator.state().t, 0.1);
  settings_.step = -1.0;
  EXPECT_THROW(Simulator(model_, start_, settings_), InputError);
}

}  // namespace
}  // namespace limber::dynamics::simulator_test
