// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/energy_record.hpp"
#include "dynamics/followed.hpp"
#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// What was seen over all steps of a run, whatever its outputs.
struct RunRecord {
  std::vector<Extreme> peaks;  ///< of what was followed
  EnergyRecord energy;
};

/// simulate() that follows scalars at every step and tells of energy. Also of a
/// run that ends in a NumericalError `record` holds what was seen.
/// @throws NumericalError also for a run that ended with more than half of its
/// throughput made or lost (dynamics/energy_verdict).
void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record);

}  // namespace limber::dynamics
