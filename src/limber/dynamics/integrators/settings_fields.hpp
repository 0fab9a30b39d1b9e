// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"

/// Field names of the settings, for manifests (common/records/fields.hpp).
namespace limber::dynamics {

constexpr auto fields_of(const StepChange*) {
  return list_fields("step change", "from [s]", "step [s]");
}

constexpr auto fields_of(const SimulationSettings*) {
  return list_fields("settings", "integrator", "end [s]", "step [s]",
                     "tolerance [m]", "passes", "most steps", "step changes",
                     "output times [s]", "rho_inf", "Newton's tolerance",
                     "Newton's iterations", "impact steps", "exact modes");
}

}  // namespace limber::dynamics
