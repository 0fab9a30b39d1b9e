// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/patches/patch_part.hpp"
#include "limber/contact/potential/series_potential.hpp"

namespace limber::contact {

/// Whether both have a potential: as PairPotential, of all pairs of parts, at
/// most 4096, but for balls on flexible surfaces.
[[nodiscard]] bool suits(const ContactSide& A, const ContactSide& B);

/// One of a shape, those of a flexible surface or of a mesh.
[[nodiscard]] std::vector<PatchPart> make_parts(const ContactSide& side);

/// Of all pairs of parts, those of the first of A first.
/// @param modulus E* > 0 [Pa]
[[nodiscard]] std::vector<SeriesPotential> make_potentials(
    const std::vector<PatchPart>& parts_A,
    const std::vector<PatchPart>& parts_B, double modulus);

}  // namespace limber::contact
