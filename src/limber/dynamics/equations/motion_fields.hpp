// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/energy_balance.hpp"

/// Field lists of a run's checkpoint data (common/records/fields.hpp).
namespace limber::dynamics {

constexpr auto fields_of(const BodyState*) {
  return list_fields("body", "position [m]", "rotation", "velocity [m/s]",
                     "angular velocity [rad/s]");
}

constexpr auto fields_of(const ControllerState*) {
  return list_fields("controller", "next sample", "memory");
}

constexpr auto fields_of(const SystemState*) {
  return list_fields("state", "time [s]", "bodies", "eta [kg^1/2 m]",
                     "etadot [kg^1/2 m/s]", "Maxwell elements [kg^1/2 m]",
                     "homes", "nodal displacements [m]",
                     "nodal velocities [m/s]", "memories", "inputs",
                     "controllers", "pair memories", "far pairs");
}

constexpr auto fields_of(const EnergyBalance*) {
  return list_fields("energy", "kinetic rigid [J]", "kinetic modal [J]",
                     "elastic [J]", "coupler [J]", "dissipated [J]", "work [J]",
                     "linear momentum [kg m/s]", "angular momentum [kg m^2/s]");
}

}  // namespace limber::dynamics
