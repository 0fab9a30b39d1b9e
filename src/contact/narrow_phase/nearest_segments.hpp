// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::contact {

/// centre + s axis, |s| <= half_length.
struct Segment {
  Vector3 centre = Vector3::Zero();  ///< [m]
  Vector3 axis = Vector3::UnitZ();   ///< unit [-]
  double half_length = 0.0;          ///< > 0 [m]
};

/// The nearest points of two segments: s on the first, t on the second [m].
struct NearestOfSegments {
  double s = 0.0;
  double t = 0.0;
};

/// For parallel segments the middle of the part that lies alongside.
///
/// Equation   the least distance is that of both lines if it is within both
///            segments, or else of an end from the other segment
/// Limits     the distance is continuous; the points jump from one end to
///            the other as segments alongside each other tilt through
///            parallel
[[nodiscard]] NearestOfSegments find_nearest(const Segment& a,
                                             const Segment& b);

}  // namespace limber::contact
