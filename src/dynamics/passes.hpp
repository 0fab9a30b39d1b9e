// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// simulate() to settings.tolerance, for settings that were checked: runs over
/// the whole time with ever shorter steps, until two of them agree so well that
/// the last is within the tolerance. The observer sees the last one alone.
///
/// Equation   a pass whose steps err by eps in sum is off by A eps at the
///            outputs; two passes, d apart there, tell A = d / (eps_1 - eps_2)
/// Source     extrapolation of the global error [@hairer1993, sec. II.4]: the
///            sum of the errors of a second-order scheme's steps is
///            proportional to its global error.
/// Limits     Motion that forgets where it came from cannot be followed: after
///            eight passes the last one counts, with a warning.
void run_to_tolerance(const SystemModel& model, SystemState& state,
                      const SimulationSettings& settings,
                      const Observer& observer, const Progress& progress,
                      SimulationStatistics& statistics,
                      const Continuation& continuation);

}  // namespace limber::dynamics
