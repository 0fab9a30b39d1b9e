// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/progress.hpp"
#include "limber/common/records/envelopes.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/monitors/contact_record.hpp"
#include "limber/dynamics/monitors/energy_record.hpp"
#include "limber/dynamics/monitors/followed.hpp"
#include "limber/dynamics/monitors/step_record.hpp"
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/dynamics/simulation/observer.hpp"
#include "limber/dynamics/simulation/simulation_statistics.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Results of monitoring all steps of a run, independent of its outputs.
struct RunRecord {
  std::vector<Extreme> peaks;  ///< of the followed scalars, in their order
  std::vector<int> places;     ///< of the peaks, -1: none (find_place)
  Envelopes envelopes;         ///< of the followed scalars
  EnergyRecord energy;
  std::vector<ContactRecord> contacts;  ///< in the order of time
  StepRecord steps;
  StepTimes times;
};

/// simulate() that also monitors scalars and energy at every step; `record` is
/// set also if a run ends in a NumericalError.
/// @throws NumericalError also for a run that gained or lost more than half of
/// its energy throughput (dynamics/monitors/energy_verdict.hpp).
void simulate(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record);

}  // namespace limber::dynamics
