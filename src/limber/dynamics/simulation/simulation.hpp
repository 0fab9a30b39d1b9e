// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/progress.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"  // IWYU pragma: export
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/dynamics/simulation/observer.hpp"  // IWYU pragma: export
#include "limber/dynamics/simulation/simulation_statistics.hpp"  // IWYU pragma: export
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Advances `state` to the end time. Steps end exactly on output times and load
/// discontinuities, and on events of couplers to the order of the integrator.
/// Modes known in closed form take no steps. After a NumericalError `state` is
/// that of the last good step, and all outputs until then were observed.
/// @throws InputError for settings outside their range; NumericalError naming
/// the body and the time.
SimulationStatistics simulate(const SystemModel& model, SystemState& state,
                              const SimulationSettings& settings,
                              const Observer& observer,
                              const Progress& progress = {});

/// The same, adding to `statistics`, which also contains the cost of a run that
/// ends in a NumericalError. With `continuation.from` the observer is not
/// called again for earlier outputs; with a tolerance it is called for all
/// outputs, at the end.
/// @param state at the start, also when resuming
/// @throws InputError also for a checkpoint that is damaged, and for a
/// controller with hidden memory where the run keeps checkpoints, continues
/// from one, or is repeated to verify a tolerance.
void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation = {});

}  // namespace limber::dynamics
