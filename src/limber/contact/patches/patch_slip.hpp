// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/patches/patch_law.hpp"
#include "limber/contact/patches/patch_memory.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// The twist of B against A about a point of the world [m/s, rad/s].
[[nodiscard]] Vector6 find_twist(const joints::PairBodies& parts,
                                 const Vector3& about_W);

/// Friction's displacement since the last commit: two points that coincided
/// then.
/// @param parts as bodies without modes
[[nodiscard]] PatchSlip find_slip(const joints::PairBodies& parts,
                                  const PatchMemory& memory);

/// The memory of a patch about p_W at a commit.
[[nodiscard]] PatchMemory remember(const joints::PairBodies& parts,
                                   const Vector3& p_W, double t,
                                   const FrictionMemory& friction);

}  // namespace limber::contact
