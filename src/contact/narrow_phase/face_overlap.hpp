// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/narrow_phase/convex_face.hpp"

namespace limber::contact {

/// A corner of the common area of two faces, as seen along a
/// normal.
struct OverlapPoint {
  double share = 0.0;  ///< of the area's edge around it [-]; 0: no corner
  Vector3 on_A = Vector3::Zero();  ///< of A's face [m]
  Vector3 on_B = Vector3::Zero();  ///< of B's face [m]
};

/// Size of the output of `find_overlap`: A's corners, B's corners, and for each
/// edge of A the points where it enters and leaves B's face.
[[nodiscard]] std::size_t count_overlap_points(std::size_t corners_A,
                                               std::size_t corners_B);

/// Fills `out`, whose size is count_overlap_points of the faces' corners. The
/// shares add up to the smaller face's number of corners, or all are zero if
/// there is no common area, as always for a point and for two lines.
///
/// Equation   share = that number times half of both edges that meet at the
///            corner over the circumference, so that it is continuous where
///            corners come and go
/// @param n unit, from A to B
/// @returns whether there is a common area
bool find_overlap(const ConvexFace& A, const ConvexFace& B, const Vector3& n,
                  std::size_t corners_A, std::size_t corners_B,
                  std::span<OverlapPoint> out);

}  // namespace limber::contact
