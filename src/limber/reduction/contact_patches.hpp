// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"

/// Patches of contact around the nodes of a surface. Part of limber_reduction.
namespace limber::flexbody {

/// A normal load on the surface around a point.
struct ContactPatch {
  Vector3 normal = Vector3::Zero();  ///< unit, outward [-]
  double radius = 0.0;               ///< b [m]
  std::vector<int> nodes;            ///< of the mesh, sorted
  VectorX weights;                   ///< sum to one [-]
};

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

/// The patch around each point of a surface.
///
/// Equation   w_n = int p N_n dA / int p dA, p = sqrt(1 - r^2 / b^2), r the
///            distance in space
/// Source     Hertz's pressure [@johnson1985, sec. 3.4]; b as large as an
///            element, below which the mesh has no flexibility to offer
/// Limits     Includes only the surface within 60 degrees of the patch's
///            normal, so that no patch reaches through a plate or around a
///            sharp edge; on a tip without such a part, all of it.
/// @param surface of `mesh`; @param normals 3 x n, unit, outward
/// @param radii n, > 0 [m]
[[nodiscard]] std::vector<ContactPatch> find_patches(
    const fem::Mesh& mesh, const fem::Surface& surface, const Matrix3X& normals,
    const VectorX& radii);

/// w^T Phi of each patch, 3n x m. @param Phi 3N x m rows of all nodes
[[nodiscard]] MatrixX average(const MatrixX& Phi,
                              const std::vector<ContactPatch>& patches);

}  // namespace limber::flexbody
