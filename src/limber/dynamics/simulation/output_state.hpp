// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// The state at a fraction [-] of a step, as interpolate(), in which stiff
/// joints transmit what they do at the step's ends, on a straight line between
/// them: by the errors of interpolated places a stiff law would transmit many
/// times as much.
/// @param begin after a jump at its time
void find_output_state(const SystemModel& model, const SystemState& begin,
                       const SystemState& end, double fraction,
                       SystemState& state);

}  // namespace limber::dynamics
