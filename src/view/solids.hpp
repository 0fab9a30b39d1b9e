// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "limber/view/recording.hpp"

namespace limber::view {

/// Triangles of a rigid body's geometry, its own frame.
struct Solid {
  Matrix3X x;                          ///< 3 x n [m]
  std::vector<std::uint32_t> corners;  ///< three a triangle, outward
};

/// A shape's surface in its body's frame; a plane is a square of the edge.
/// @param edge > 0 [m]
[[nodiscard]] Solid make_solid(const Shape& shape, double edge);

/// The homogeneous ellipsoid of a mass and principal moments of inertia J.
///
/// Equation   m a_i^2 / 5 = tr(J) / 2 - J_ii
/// @param inertia body frame; its eigenvectors are the axes [kg m^2]
[[nodiscard]] Solid make_ellipsoid(double mass, const Matrix3& inertia);

}  // namespace limber::view
