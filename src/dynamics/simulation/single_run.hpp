// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/run_record.hpp"

namespace limber::dynamics {

/// simulate() for settings that were checked, over the whole time once. Of
/// steps to a tolerance, each may err by it, which does not tell the error at
/// the end: run_to_tolerance (dynamics/passes.hpp), which also says by what
/// `refinement` their other limits are shortened.
void run_once(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record, double refinement = 1.0);

}  // namespace limber::dynamics
