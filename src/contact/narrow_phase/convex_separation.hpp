// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/narrow_phase/convex_core.hpp"

namespace limber::contact {

/// How far two convex sets overlap, balls included.
///
/// Equation   depth = min over unit n of max_A n . x - min_B n . x: the least
///            way that parts them, or minus their distance
struct Separation {
  Vector3 normal_W = Vector3::UnitZ();  ///< n, from A to B [-]
  double depth = 0.0;                   ///< [m]
  /// Where both are nearest, without balls, if they are apart.
  Vector3 on_A = Vector3::Zero();  ///< [m]
  Vector3 on_B = Vector3::Zero();  ///< [m]
  bool is_apart = false;           ///< without balls
};

/// Apart, by the nearest points; next to a disc's rim the normal is the better
/// one of theirs and of those below. Overlapping, by all directions in which
/// the least way may lie: across two segments, along a disc's axis, and, with a
/// disc's rim, across one segment or any. Where directions are equally good to
/// 1e-9 of the sizes, the first in a fixed order.
///
/// Source     polytopes: [@gottschalk1996]; a disc adds no others because the
///            least way along a smooth arc of directions needs a radius of
///            curvature larger than the depth
/// Limits     depth of two cylinders' rims that cross: a minimum next to the
///            best of 200 directions
[[nodiscard]] Separation find_separation(const ConvexCore& A,
                                         const ConvexCore& B);

}  // namespace limber::contact
