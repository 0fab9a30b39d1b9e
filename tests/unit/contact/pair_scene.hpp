// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::contact::test {

/// A system with pairs that touch, run on from where it is.
struct PairScene {
  dynamics::SystemModel model;
  dynamics::SystemState state;
  dynamics::RunRecord record = {};
  dynamics::SimulationStatistics statistics = {};

  void go(double time, double step,
          dynamics::IntegratorKind scheme =
              dynamics::IntegratorKind::generalized_alpha) {
    simulate(model, state,
             {.integrator = scheme, .end_time = time, .step = step}, {}, {},
             statistics, {}, {}, record);
  }
  [[nodiscard]] dynamics::BodyState& body() { return state.bodies[0]; }
  [[nodiscard]] dynamics::EnergyBalance find_energy() const {
    return calc_energy(model, state);
  }
};

}  // namespace limber::contact::test
