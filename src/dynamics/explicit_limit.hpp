// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/system_model.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// The settings that explicit schemes run with: steps that are too long to be
/// stable about the start are divided, by a thousand at most, which
/// `statistics` tell (stable_step; of Runge-Kutta and splitting a warning).
///
/// Equation   central differences: 0.95 of find_stable_step. Runge-Kutta and
///            splitting: a tenth of it, so that what a step ends within
///            itself is dissipated as the audit has it, or if that takes more
///            than a thousand parts 0.95 of it; but only where the step's own
///            derivative, (q, h v) at a step's end by that at its start,
///            magnifies by more than 1.05 a step: their find_stable_step is a
///            bound from below.
/// Limits     what stiffens the system later is not foreseen. Where a thousand
///            parts do not suffice, central differences are refused; the
///            others go on as asked, with a warning, under the driver's guard.
///            Explicit Euler is left alone: without dampers no step is stable.
/// @param state the start
/// @throws InputError of central differences that would need more parts.
[[nodiscard]] SimulationSettings limit_step(const SystemModel& model,
                                            const SystemState& state,
                                            const SimulationSettings& asked,
                                            SimulationStatistics& statistics);

/// By how much a step of `settings.step` magnifies small changes of `state`,
/// about, each time it is taken: the spectral radius of its derivative [-].
/// Infinite if such a step fails. Motion that drifts reads as up to 1.02.
[[nodiscard]] double find_growth(const SystemModel& model,
                                 const SystemState& state,
                                 const SimulationSettings& settings);

}  // namespace limber::dynamics
