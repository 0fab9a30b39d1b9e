// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"
#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/body_with_surface.hpp"
#include "limber/reduction/contact_groups.hpp"

/// Surfaces of a body that may be in contact with others. Part of
/// limber_reduction.
namespace limber::flexbody {

/// The surfaces of the recipe's contact groups.
/// @param basis on the free nodes; @param Phi its 3N x m rows of all nodes
/// @param center of mass, mesh frame [m]
/// @throws InputError as find_contact_groups
[[nodiscard]] std::vector<ContactSurface> make_contact_surfaces(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis,
    const MatrixX& Phi, const Vector3& center, const Progress& progress);

/// The surfaces of groups. @param Phi 3N x m rows of the surface's nodes
[[nodiscard]] std::vector<ContactSurface> make_contact_surfaces(
    const BodyWithSurface& body, const std::vector<ContactGroup>& groups,
    const ReducedBasis& basis, const MatrixX& Phi, const Vector3& center,
    const Progress& progress);

/// The same for the body without reduction.
/// @param materials one a region of the mesh
/// @param reduced the same body, whose parts and slices they have; null: none
[[nodiscard]] std::vector<FullContactSurface> make_full_contact_surfaces(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<fem::ElasticMaterial>& materials, const Vector3& center,
    const ReducedBody* reduced);

/// Whether all points lie in one plane, to a millionth of the surface's size.
[[nodiscard]] bool is_flat(const fem::Surface& surface,
                           const Matrix3X& normals);

}  // namespace limber::flexbody
