// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/contact/shapes/placed_shape.hpp"

namespace limber::contact {

/// The middle of all points of a round body that are as low
/// along `up` as its lowest one, in the world frame [m].
/// @param up unit
/// @param level sine of an angle up to which a line or disc lies level [-]
[[nodiscard]] Vector3 find_lowest_round(const PlacedShape& body,
                                        const Vector3& up, double level);

}  // namespace limber::contact
