// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/simulation/simulation_statistics.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Settings with which explicit schemes run: steps too long to be stable about
/// the initial state are divided, into at most a thousand parts. `statistics`
/// gets the stable step of central differences, and a warning for Runge-Kutta
/// and splitting.
///
/// Equation   central differences: 0.95 of find_stable_step. Runge-Kutta and
///            splitting: a tenth of it, so that motion damped out within a step
///            is dissipated as the energy audit expects, or 0.95 of it if a
///            tenth takes more than a thousand parts; but only where the
///            derivative of a step, of (q, h v) at its end with respect to its
///            start, amplifies by more than 1.05, since their find_stable_step
///            is a lower bound.
/// Limits     later stiffening of the system is not considered. If a thousand
///            parts do not suffice, central differences are rejected; the
///            others run with the given step, a warning and the time loop's
///            check for blow-up. Explicit Euler is not limited: without dampers
///            no step is stable.
/// @param state at the start
/// @throws InputError for central differences that need more parts.
[[nodiscard]] SimulationSettings limit_step(const SystemModel& model,
                                            const SystemState& state,
                                            const SimulationSettings& requested,
                                            SimulationStatistics& statistics);

/// Approximate factor by which a step of `settings.step` amplifies small
/// changes of `state`: the spectral radius of its derivative [-]. Infinite if
/// the step fails. Rigid motion gives up to 1.02.
[[nodiscard]] double find_growth(const SystemModel& model,
                                 const SystemState& state,
                                 const SimulationSettings& settings);

}  // namespace limber::dynamics
