// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/shapes/meeting.hpp"
#include "limber/contact/shapes/placed_shape.hpp"

/// The rules of ShapePair, with A the sphere, half space or capsule.
namespace limber::contact {

/// Of a sphere with any shape.
///
/// Equation   depth = radius - distance of the centre from B's surface
[[nodiscard]] Meeting meet_sphere(const PlacedShape& A, const PlacedShape& B,
                                  double reach);
/// A lower bound of the distance; < 0 if they overlap [m].
[[nodiscard]] double find_sphere_clearance(const PlacedShape& A,
                                           const PlacedShape& B);

/// Of two capsules.
///
/// Limits     one point: see find_nearest of segments
[[nodiscard]] Meeting meet_capsules(const PlacedShape& A, const PlacedShape& B);

/// Of B's features with a half space: how many, and each of them.
///
/// Equation   depth = -height of the feature's lowest point
[[nodiscard]] std::size_t count_half_space_features(const Shape& B);
void meet_half_space(const PlacedShape& A, const PlacedShape& B, double reach,
                     std::span<Meeting> out);
/// The distance; < 0 if they overlap [m].
[[nodiscard]] double find_half_space_clearance(const PlacedShape& A,
                                               const PlacedShape& B);

}  // namespace limber::contact
