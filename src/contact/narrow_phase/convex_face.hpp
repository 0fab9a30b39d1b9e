// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "limber/common/types.hpp"
#include "limber/contact/narrow_phase/placed_shape.hpp"

namespace limber::contact {

/// The part of a convex shape that faces a direction: a face of a box, the end
/// of a cylinder as a hexagon with one corner farthest along it, the line of a
/// cylinder's or capsule's side there, or an end of a capsule.
struct ConvexFace {
  static constexpr std::size_t kMostCorners = 6;
  std::array<Vector3, kMostCorners> corners = {};  ///< around it [m]
  std::size_t count = 0;   ///< 1 of a point, 2 of a line
  double curvature = 0.0;  ///< mean, of the surface there [1/m]

  void add(const Vector3& corner) { corners[count++] = corner; }
};

/// @param n unit, world frame; of a ball the surface towards n counts
/// @param shape a box, cylinder or capsule
[[nodiscard]] ConvexFace find_face(const PlacedShape& shape, const Vector3& n);

/// Largest number of corners of a shape's face.
[[nodiscard]] std::size_t count_face_corners(const Shape& shape);

}  // namespace limber::contact
