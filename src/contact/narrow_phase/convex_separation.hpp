// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/narrow_phase/convex_core.hpp"

namespace limber::contact {

/// Overlap or distance of two convex sets, balls included.
///
/// Equation   depth = min over unit n of max_A n . x - min_B n . x: the least
///            way that parts them, or minus their distance
struct Separation {
  Vector3 normal_W = Vector3::UnitZ();  ///< n, from A to B [-]
  double depth = 0.0;                   ///< [m]
  /// The nearest points, without balls, if the sets are apart.
  Vector3 on_A = Vector3::Zero();  ///< [m]
  Vector3 on_B = Vector3::Zero();  ///< [m]
  bool is_apart = false;           ///< without balls
};

/// If apart, from the nearest points; next to a disc's rim the better of their
/// normal and the directions below. If overlapping, from all candidate
/// directions of least depth: normal to two segments, along a disc's axis, and,
/// with a disc's rim, normal to one segment or any. Of directions that are
/// equal to 1e-9 of the sizes it takes the first in a fixed order.
///
/// Source     polytopes: [@gottschalk1996]; a disc adds no others because the
///            least way along a smooth arc of directions needs a radius of
///            curvature larger than the depth
/// Limits     depth of two cylinders' rims that cross: a minimum next to the
///            best of 200 directions
[[nodiscard]] Separation find_separation(const ConvexCore& A,
                                         const ConvexCore& B);

}  // namespace limber::contact
