// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "limber/contact/patches/contact_side.hpp"
#include "limber/contact/patches/patch_finder.hpp"
#include "limber/contact/patches/patch_part.hpp"

namespace limber::contact {

/// Whether they touch as BallOnSurface.
[[nodiscard]] bool has_ball_on_surface(const ContactSide& A,
                                       const ContactSide& B);

/// Whether both have patches: convex parts with a PairPotential each, at most
/// 4096 pairs of them; or a ball and a flexible surface.
[[nodiscard]] bool suits(const ContactSide& A, const ContactSide& B);

/// One of a shape, those of a flexible surface or of a mesh.
[[nodiscard]] std::vector<PatchPart> make_parts(const ContactSide& side);

/// @param modulus E* > 0 [Pa]
/// @throws ContractError unless suits(A, B).
[[nodiscard]] std::unique_ptr<const PatchFinder> make_finder(
    const ContactSide& A, const ContactSide& B, double modulus,
    const ContactParameters& parameters);

}  // namespace limber::contact
