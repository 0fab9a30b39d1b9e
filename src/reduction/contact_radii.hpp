// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/mesh/surface.hpp"

/// Sizes of contact patches. Part of limber_reduction.
namespace limber::flexbody {

/// Largest radius of a patch as a part of the body's thickness [-].
inline constexpr double kMostOfThickness = 0.75;
/// Smallest radius of a patch as a part of the edges' mean length [-].
inline constexpr double kLeastOfEdge = 0.1;

/// Unit outward normals at the points of a surface, 3 x n: of the mean vector
/// area of the faces there.
[[nodiscard]] Matrix3X find_normals(const fem::Mesh& mesh,
                                    const fem::Surface& surface);

/// Radii of the patches around the points of a surface [m]: at a corner the
/// mean length of the edges there, at most kMostOfThickness of the distance
/// through the body along the inward normal and at least kLeastOfEdge of these
/// edges; in between the mean of both ends.
/// @param normals as find_normals
[[nodiscard]] VectorX find_patch_radii(const fem::Mesh& mesh,
                                       const fem::Surface& surface,
                                       const Matrix3X& normals);

}  // namespace limber::flexbody
