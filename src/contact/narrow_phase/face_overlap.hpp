// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/contact/narrow_phase/convex_face.hpp"

namespace limber::contact {

/// A corner of the area in which two faces cover each other, seen along a
/// normal.
struct OverlapPoint {
  double share = 0.0;  ///< of the area's edge around it [-]; 0: no corner
  Vector3 on_A = Vector3::Zero();  ///< of A's face [m]
  Vector3 on_B = Vector3::Zero();  ///< of B's face [m]
};

/// Numbers of corners of `find_overlap`: A's corners, B's corners, and of each
/// edge of A where it enters B's face and where it leaves it.
[[nodiscard]] std::size_t count_overlap_points(std::size_t corners_A,
                                               std::size_t corners_B);

/// Fills `out`, of count_overlap_points of the shapes' corners. The shares of
/// all add up to the smaller face's number of corners, or there is none: none
/// either of a point, and of two lines.
///
/// Equation   share = that number times half of both edges that meet at the
///            corner over the circumference, so that it is continuous where
///            corners come and go
/// @param n unit, from A to B
/// @returns whether there are any
bool find_overlap(const ConvexFace& A, const ConvexFace& B, const Vector3& n,
                  std::size_t corners_A, std::size_t corners_B,
                  std::span<OverlapPoint> out);

}  // namespace limber::contact
