// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Checks the state at the end of an explicit step of length h [s].
/// @throws NumericalError naming the body and the time if a motion is not
/// finite.
void require_finite(const SystemModel& model, const SystemState& state,
                    double h);

}  // namespace limber::dynamics
