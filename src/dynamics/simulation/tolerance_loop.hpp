// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/run_record.hpp"

namespace limber::dynamics {

/// simulate() to settings.tolerance, for settings that were checked: runs over
/// the whole time with ever shorter steps, until two of them agree so well that
/// the last is within the tolerance. The observer sees the last one alone.
///
/// Equation   the sum of the errors of steps that may each err by eps, and the
///            pass's error with it, goes as eps^(2/3): steps that err as h^3
///            are as eps^(-1/3) many. Two passes, d apart at the outputs, tell
///            the second's error, d / ((eps_1 / eps_2)^(2/3) - 1)
/// Source     extrapolation of the global error [@hairer1993, sec. II.4]: the
///            sum of the errors of a second-order scheme's steps is
///            proportional to its global error.
/// Limits     Motion that forgets where it came from cannot be followed: after
///            eight passes the last one counts, with a warning.
void run_to_tolerance(const SystemModel& model, SystemState& state,
                      const SimulationSettings& settings,
                      const Observer& observer, const Progress& progress,
                      SimulationStatistics& statistics,
                      const Continuation& continuation,
                      const Followed& followed, RunRecord& record);

}  // namespace limber::dynamics
