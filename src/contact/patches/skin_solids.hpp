// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/contact/potential/convex_solid.hpp"
#include "limber/flexbody/model/contact_surface.hpp"

namespace limber::contact {

/// Largest number of convex solids of a flexible surface.
inline constexpr std::size_t kMostSkinSolids = 32;

/// Convex parts of the slices of a flexible surface, in its body's frame.
struct SkinSolids {
  std::vector<ConvexSolid> solids;
  std::vector<std::size_t> slices;  ///< of each solid
};

/// The solid of a closed surface of flat faces, as split_mesh, each part cut by
/// the planes of each slice. Faces in these planes do not press.
/// @returns nothing of a surface without slices, beyond the limits of
/// split_mesh, and of more than kMostSkinSolids
[[nodiscard]] SkinSolids split_skin(const flexbody::ContactSurface& surface);

}  // namespace limber::contact
