// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// The state within a step, interpolated from those at its ends.
///
/// Equation   q(s) = q_0 o exp(c(s)), c the cubic with c(0) = 0, c(1) = inc and
///            the rates of both ends; velocities are its derivative
/// Source     cubic Hermite interpolation [@hairer1993, sec. II.6], rotation on
///            the group
/// Limits     error of fourth order in the step; of velocities, third
/// @param fraction fraction of the step, in [0, 1] [-]
/// @param state sized as the ends; its coupler memories become those of `begin`
void interpolate(const SystemModel& model, const SystemState& begin,
                 const SystemState& end, double fraction, SystemState& state);

}  // namespace limber::dynamics
