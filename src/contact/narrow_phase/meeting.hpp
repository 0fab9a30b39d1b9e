// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// The closest points at a feature of a pair of shapes, such as a corner and a
/// plane.
///
/// Equation   d depth = normal . (d p_A - d p_B), p of both material points
struct Meeting {
  /// > 0: overlap, < 0: minus the distance, -infinity beyond the reach that was
  /// asked for; then all else is undefined [m].
  double depth = -std::numeric_limits<double>::infinity();
  Vector3 normal_W = Vector3::UnitZ();  ///< unit, from A to B [-]
  Vector3 p_W = Vector3::Zero();  ///< midway between both surfaces' points [m]
  SurfacePlace on_A;
  SurfacePlace on_B;
  /// 1/R_e: the mean curvatures of both sides (half the sum of the principal
  /// ones, convex > 0), added, and 0 if that is negative. Edges and corners
  /// count as flat [1/m].
  double curvature = 0.0;
  /// Factor > 0 on the force at this depth, where several features represent
  /// one area [-].
  double share = 1.0;
};

}  // namespace limber::contact
