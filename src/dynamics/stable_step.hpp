// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Longest step with which central differences are stable about `state` [s].
///
/// Equation   h = (sqrt(c^2 + 4 omega^2) - c) / omega^2: 2 / omega without
///            damping; omega^2 and c the largest eigenvalues of the change of
///            accelerations with positions and with velocities, by power
///            iteration on differences of the equations of motion
/// Source     [@belytschko2000, eq. 6.2.19], with c = 2 xi omega
/// Limits     a thousandth long at most, by when the iteration ends; motion
///            that stiffens the system later is not foreseen. Infinite if
///            nothing vibrates.
[[nodiscard]] double find_stable_step(const SystemModel& model,
                                      const SystemState& state);

/// The share of it that simulate() takes.
inline constexpr double kStableShare = 0.95;

}  // namespace limber::dynamics
