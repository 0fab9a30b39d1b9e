// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/modal/reduced_basis.hpp"
#include "limber/flexbody/model/contact_surface.hpp"
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

}  // namespace limber::flexbody
