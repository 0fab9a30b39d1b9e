// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/simulation/run_record.hpp"

namespace limber::dynamics {

/// Of the limits of steps that do not depend on their errors, in the only pass
/// to a tolerance [-].
inline constexpr double kOnePassRefinement = 0.5;

/// simulate() for checked settings, with one pass over the whole time. A
/// tolerance is shared by the errors of all steps (TolerancePasses::one), or is
/// the error of each step in one of several passes (run_to_tolerance,
/// dynamics/simulation/tolerance_loop.hpp).
/// @param refinement factor of the other limits of steps, see StepControl [-]
void run_once(const SystemModel& model, SystemState& state,
              const SimulationSettings& settings, const Observer& observer,
              const Progress& progress, SimulationStatistics& statistics,
              const Continuation& continuation, const Followed& followed,
              RunRecord& record, double refinement = 1.0);

}  // namespace limber::dynamics
