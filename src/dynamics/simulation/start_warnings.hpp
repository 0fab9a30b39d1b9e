// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Adds an event and a warning for each stop beyond which a joint or a
/// transmission is in `state`, the start of a run: how far, and what it stores.
void add_start_warnings(const SystemModel& model, const SystemState& state,
                        SimulationStatistics& statistics);

}  // namespace limber::dynamics
