// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// The state within a step, from those at its ends.
///
/// Equation   q(s) = q_0 o exp(c(s)), c the cubic with c(0) = 0, c(1) = inc and
///            the rates of both ends; velocities are its derivative
/// Source     cubic Hermite interpolation [@hairer1993, sec. II.6], rotation on
///            the group
/// Limits     of fourth order in the step; velocities of third
/// @param share of the step, in [0, 1]
/// @param state sized as the ends; remembers what the step began with
void interpolate(const SystemModel& model, const SystemState& begin,
                 const SystemState& end, double share, SystemState& state);

}  // namespace limber::dynamics
