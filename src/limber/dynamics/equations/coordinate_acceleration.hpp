// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Acceleration of a joint's coordinate by the bodies' accelerations, without
/// what depends on its rate [m/s^2 or rad/s^2].
/// @param terms at `state`
/// @param accelerations of all unknowns, overwritten
/// @param moving overwritten
[[nodiscard]] double find_coordinate_acceleration(
    const SystemModel& model, const SystemState& state,
    const SystemTerms& terms, CouplerIndex coupler, std::size_t coordinate,
    VectorX& accelerations, SystemState& moving);

}  // namespace limber::dynamics
