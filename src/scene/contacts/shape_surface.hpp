// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/scene/robot/geometry.hpp"

namespace limber::scene {

/// Triangles of a shape.
struct ShapeSurface {
  Matrix3X points;  ///< 3 x n, the shape's frame [m]
  std::vector<std::array<std::size_t, 3>> triangles;  ///< outward (right-hand)
};

/// A coarse surface for pictures, with corners on the shape's own; none of a
/// plane and of what contacts do not know.
[[nodiscard]] ShapeSurface make_surface(const Geometry& geometry);

}  // namespace limber::scene
