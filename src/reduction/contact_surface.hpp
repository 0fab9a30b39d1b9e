// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"
#include "limber/reduction/meshed_body.hpp"

/// Surfaces of a body that may touch others. Part of limber_reduction.
namespace limber::flexbody {

/// The surfaces of the recipe's contact groups.
/// @param basis on the free nodes; @param Phi its 3N x m rows of all nodes
/// @param center of mass, mesh frame [m]
/// @throws InputError as find_contact_groups
[[nodiscard]] std::vector<ContactSurface> make_contact_surfaces(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis,
    const MatrixX& Phi, const Vector3& center, const Progress& progress);

/// The same for the body without reduction; these have no pads.
/// @param materials one a region of the mesh
[[nodiscard]] std::vector<FullContactSurface> make_full_contact_surfaces(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<fem::ElasticMaterial>& materials, const Vector3& center);

/// Largest number of pads of a surface.
inline constexpr int kMostPads = 25;

/// Whether all points lie in one plane, to a millionth of the surface's size.
[[nodiscard]] bool is_flat(const fem::Surface& surface,
                           const Matrix3X& normals);

/// Divides a flat surface into pads about some of its corner nodes, at most
/// kMostPads of them: each is the part that is nearest to its node.
///
/// Equation   nodes that are farthest from those chosen before, from the one
///            farthest from the centre on, up to where the distance drops, so
///            that regular meshes have regular pads; weights of a pad
///            w_n = int_pad N_n dA / int_pad dA
/// Source     [@gonzalez1985] for the nodes
/// @param normals 3 x n, unit, outward
/// @param basis on the free nodes; @param Phi its 3N x m rows of all nodes
/// @param center of mass, mesh frame [m]
[[nodiscard]] ContactPads make_contact_pads(const MeshedBody& body,
                                            const fem::Surface& surface,
                                            const Matrix3X& normals,
                                            const ReducedBasis& basis,
                                            const MatrixX& Phi,
                                            const Vector3& center);

}  // namespace limber::flexbody
