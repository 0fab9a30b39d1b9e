// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/surface.hpp"
#include "limber/flexbody/model/full_contact_surface.hpp"

/// Parts and slices of a surface by the nodes of its mesh. Part of
/// limber_reduction.
namespace limber::flexbody {

/// SliceMotion of the samples that lie in each part, or else slice: of those in
/// none, as at the rim of a round surface, in the nearest one.
/// @param surface of `mesh` @param contact with parts or slices
/// @param center of mass, mesh frame [m]
[[nodiscard]] std::vector<NodalPiece> find_nodal_pieces(
    const fem::Mesh& mesh, const fem::Surface& surface,
    const ContactSurface& contact, const Vector3& center);

}  // namespace limber::flexbody
