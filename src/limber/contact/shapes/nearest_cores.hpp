// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/shapes/convex_core.hpp"

namespace limber::contact {

/// The nearest points of two sets without their balls.
struct NearestOfCores {
  Vector3 on_A = Vector3::Zero();  ///< [m]
  Vector3 on_B = Vector3::Zero();  ///< [m]
  bool overlap = false;            ///< then both points are undefined
};

/// Source     [@gilbert1988], the nearest point of a simplex from its faces
/// Limits     sets closer than 1e-10 of their size count as overlapping
[[nodiscard]] NearestOfCores find_nearest(const ConvexCore& A,
                                          const ConvexCore& B);

}  // namespace limber::contact
