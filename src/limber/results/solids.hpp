// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/common/types.hpp"

/// Shapes of rigid bodies as triangles, for pictures.
namespace limber::results {

/// A shape in its own frame.
struct SolidShape {
  /// "box", "sphere", "cylinder", "capsule", "cone", "ellipsoid", "plane" or
  /// "mesh"
  std::string kind;
  /// Box: whole edges; sphere: radius; cylinder, capsule and cone: radius,
  /// length (of a capsule that of its axis), along z, to a cone's tip;
  /// ellipsoid: radii; plane (z = 0) and mesh: none [m].
  Vector3 size = Vector3::Zero();
  Matrix3X x;                          ///< 3 x n corners of a mesh [m]
  std::vector<std::uint32_t> corners;  ///< of a mesh, three a triangle, outward
};

/// Triangles.
struct Solid {
  Matrix3X x;                          ///< 3 x n [m]
  std::vector<std::uint32_t> corners;  ///< three a triangle, outward
};

/// A shape's surface in its own frame; a plane is a square of the edge.
/// @param edge > 0 [m]
[[nodiscard]] Solid make_solid(const SolidShape& shape, double edge);

/// The solid in the frame B. @param X_BS of the solid's frame
[[nodiscard]] Solid place_solid(Solid solid, const Pose& X_BS);

/// The homogeneous ellipsoid of a mass and principal moments of inertia J.
///
/// Equation   m a_i^2 / 5 = tr(J) / 2 - J_ii
/// @param inertia body frame; its eigenvectors are the axes [kg m^2]
[[nodiscard]] Solid make_ellipsoid(double mass, const Matrix3& inertia);

}  // namespace limber::results
