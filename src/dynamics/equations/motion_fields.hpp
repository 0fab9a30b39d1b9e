// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/energy.hpp"
#include "dynamics/event.hpp"
#include "dynamics/residual.hpp"
#include "dynamics/simulation.hpp"
#include "dynamics/system_state.hpp"
#include "joints/fields.hpp"

/// What of a run goes into a checkpoint, field by field (common/fields.hpp).
namespace limber::dynamics {

constexpr auto fields_of(const BodyState*) {
  return list_fields("body", "position [m]", "rotation", "velocity [m/s]",
                     "angular velocity [rad/s]");
}

constexpr auto fields_of(const SystemState*) {
  return list_fields("state", "time [s]", "bodies", "eta [kg^1/2 m]",
                     "etadot [kg^1/2 m/s]", "homes", "nodal displacements [m]",
                     "nodal velocities [m/s]", "memories");
}

constexpr auto fields_of(const Rates*) {
  return list_fields("rates", "translation", "rotation", "modes", "nodes");
}

constexpr auto fields_of(const Accelerations*) {
  return list_fields("accelerations", "a_WB_W [m/s^2]", "dw_WB_B [rad/s^2]",
                     "etaddot [kg^1/2 m/s^2]", "uddot_H [m/s^2]");
}

constexpr auto fields_of(const Event*) {
  return list_fields("event", "time [s]", "source", "what",
                     "rate [m/s, rad/s]");
}

constexpr auto fields_of(const EnergyBalance*) {
  return list_fields("energy", "kinetic rigid [J]", "kinetic modal [J]",
                     "elastic [J]", "coupler [J]", "dissipated [J]", "work [J]",
                     "linear momentum [kg m/s]", "angular momentum [kg m^2/s]");
}

/// Counts of work, which add up over a run.
inline void exchange_costs(Archive& archive, SimulationStatistics& statistics) {
  archive(statistics.steps, statistics.rejected_steps, statistics.halved_steps,
          statistics.newton_iterations, statistics.factorizations,
          statistics.linear_solves);
}

}  // namespace limber::dynamics
