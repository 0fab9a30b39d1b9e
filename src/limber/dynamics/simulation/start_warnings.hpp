// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/simulation/simulation_statistics.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Adds an event and a warning, with the excess and its energy, for each stop
/// that a joint or a transmission exceeds in `state`, the start of a run.
void add_start_warnings(const SystemModel& model, const SystemState& state,
                        SimulationStatistics& statistics);

/// Adds a warning of the load or drive whose period has the fewest fixed steps,
/// if they are fewer than eight; none for steps to a tolerance, which follow
/// all.
/// @param start of the run [s]
void add_period_warning(const SystemModel& model,
                        const SimulationSettings& settings, double start,
                        SimulationStatistics& statistics);

}  // namespace limber::dynamics
