// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/contact/potential/body_kind.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

namespace limber::contact {

/// Largest number of convex bodies of a flexible surface.
inline constexpr std::size_t kMostSurfaceParts = 32;

/// Convex bodies that represent the slices of a flexible surface, in its body's
/// frame.
struct SurfaceParts {
  std::vector<PlacedBody> bodies;
  std::vector<std::size_t> slices;  ///< of each body
  /// The largest distance between the surface and its replacement: nothing
  /// of flat faces; of round ones how far they are from round, or the thickness
  /// of a tube's wall [m].
  double error = 0.0;
};

/// A closed surface of flat faces is that solid, as split_mesh, each part cut
/// by the planes of each slice. Faces in these planes do not press.
/// Of another surface each slice is one body: a ball, a cylinder with its ends,
/// or a capsule (see find_round_body), or else a hull (see find_hull).
/// So is one of flat faces that has more than kMostSurfaceParts of these parts.
/// @returns nothing of a surface without slices
[[nodiscard]] SurfaceParts split_surface(
    const flexbody::ContactSurface& surface);

/// Convex bodies that represent a rigid mesh which split_mesh does not divide,
/// or divides too finely: hulls (see find_hull) of what lies in boxes, which
/// are halved where the hulls are farther from the surface than 1e-3 of its
/// size, up to kMostSurfaceParts.
/// @returns no slices
[[nodiscard]] SurfaceParts cover_mesh(const flexbody::ContactSurface& mesh);

}  // namespace limber::contact
