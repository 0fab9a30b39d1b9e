// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/contact/potential/convex_solid.hpp"

namespace limber::contact {

/// Largest number of convex parts of a mesh.
inline constexpr std::size_t kMostSolids = 256;
/// Largest number of parts under one flat of it.
inline constexpr std::size_t kMostSideBySide = 32;

/// The inside of a closed surface of flat triangles as convex parts: itself if
/// it is convex, else cut along its own faces, again and again the one through
/// which the shortest cut goes. Faces of a part press where they are the
/// surface at least in part, not where another part continues. Triangles in a
/// plane, within 1e-6 of the surface's size, are one face.
///
/// Limits     up to 2000 different planes of a convex surface, 600 of another,
///            kMostSolids parts, kMostSideBySide of them with a face in a plane
/// @param x_B 3 x n corners [m] @param faces outward triangles, by the first
/// three of each
/// @returns nothing beyond these limits, or where the parts have not the volume
/// of the surface within 1e-4
[[nodiscard]] std::vector<ConvexSolid> split_mesh(
    const Matrix3X& x_B, const std::vector<std::array<int, 6>>& faces);

}  // namespace limber::contact
