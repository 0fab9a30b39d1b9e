// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// Where a feature of a pair of shapes, such as a corner and a plane, is
/// closest.
///
/// Equation   d depth = normal . (d p_A - d p_B), p of both material points
struct Meeting {
  /// > 0: overlap, < 0: minus the distance, -infinity where it is farther than
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
  /// Factor on the force of this depth, > 0, where several features stand for
  /// one area [-].
  double share = 1.0;
};

}  // namespace limber::contact
