// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// simulate() for settings that were checked, over the whole time once. Steps
/// to a tolerance hold it in the sum of their errors, which is not yet the
/// error at the end: run_to_tolerance (dynamics/passes.hpp).
void run_once(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation);

}  // namespace limber::dynamics
