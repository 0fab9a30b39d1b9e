// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/potential/convex_solid.hpp"

namespace limber::contact {

/// The common part of two solids, facets with ConvexSolid::tag_of(face, side);
/// empty if they are apart. Cut out of a box about it, along the face normal of
/// least overlap, by those faces alone that pass through this box.
/// @param A, B one of them bounded @param out in the axes of the poses
void find_overlap(const ConvexSolid& A, const Pose& X_A, const ConvexSolid& B,
                  const Pose& X_B, Polytope& out);

}  // namespace limber::contact
