// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/simulation/run_record.hpp"

namespace limber::dynamics {

/// Which passes a run from time `start` [s] makes to settings.tolerance: those
/// of the settings, or of `automatic` verified ones if a load or a command
/// oscillates in the run, and no controller has hidden memory. Errors of
/// an oscillation's steps add up in the velocity of what nothing restores: one
/// pass missed its tolerance by up to 14 times then.
[[nodiscard]] TolerancePasses choose_passes(const SystemModel& model,
                                            const SimulationSettings& settings,
                                            double start);

/// simulate() to settings.tolerance with TolerancePasses::verified, for checked
/// settings: passes over the whole time with decreasing steps, until the
/// difference of two shows that the last is within the tolerance. The observer
/// is called for the last pass only.
///
/// Equation   with an error eps of each step, the sum of their errors, and so
///            the error of a pass, is proportional to eps^(2/3), since errors
///            go as h^3 and the number of steps as eps^(-1/3). From two passes
///            that differ by d at the outputs, the error of the second is
///            d / ((eps_1 / eps_2)^(2/3) - 1)
/// Source     extrapolation of the global error [@hairer1993, sec. II.4]: the
///            sum of the errors of a second-order scheme's steps is
///            proportional to its global error.
/// Limits     Chaotic motion does not converge: after eight passes the last one
///            is taken, with a warning.
void run_to_tolerance(const SystemModel& model, SystemState& state,
                      const SimulationSettings& settings,
                      const Observer& observer, const Progress& progress,
                      SimulationStatistics& statistics,
                      const Continuation& continuation,
                      const Followed& followed, RunRecord& record);

}  // namespace limber::dynamics
