// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/shapes/face_patch.hpp"

namespace limber::contact {

/// Two places, one on each of two faces, that are opposite each other.
struct FacePairPlace {
  FacePlace on_A;
  FacePlace on_B;
  Vector3 normal = Vector3::UnitZ();  ///< unit, from A to B [-]
  double depth = 0.0;  ///< overlap along it, or minus the distance [m]
};

/// Where two faces are closest, or overlap most: the points are apart along a
/// normal of both. On an edge or a corner any normal between those of the sides
/// counts: each point may be within its face, on an edge or in a corner.
///
/// Equation   a - b = d n, n . a' = 0, n . b' = 0 along all directions in which
///            each place can move; Newton's method on the places and n, from
///            the shortest line between A and B after B is moved off along n.
///            So it is regular at d = 0, where the distance itself is not.
/// Limits     a local solution. Flat faces in parallel have many; one of them
///            is found, to round-off in depth.
/// @param normal towards B, about that of both faces, unit [-]
/// @param most_depth largest overlap to be found [m]
/// @param is_inner whether smooth faces adjoin all edges of both
/// (Skin::FaceMeasures::overshoot): a place far outside of its face then
/// belongs to another face and is rejected here
/// @returns none if the faces do not face each other there
[[nodiscard]] std::optional<FacePairPlace> find_opposite(const FacePatch& A,
                                                         const FacePatch& B,
                                                         const Vector3& normal,
                                                         double most_depth,
                                                         bool is_inner);

/// Where two straight segments cross as seen along `normal`: the weights of
/// their second ends, in [0, 1] [-]. None if parallel or apart.
struct SegmentCrossing {
  double s = 0.0;
  double t = 0.0;
};
[[nodiscard]] std::optional<SegmentCrossing> find_crossing(
    const Vector3& a0, const Vector3& a1, const Vector3& b0, const Vector3& b1,
    const Vector3& normal);

}  // namespace limber::contact
