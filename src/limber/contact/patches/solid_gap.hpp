// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/patches/patch_part.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// From a place of A to one of B, apart from each other; world frame.
struct SolidGap {
  Vector3 normal_W = Vector3::Zero();  ///< from A to B, unit; 0: unknown
  Vector3 on_A = Vector3::Zero();      ///< [m]
  Vector3 on_B = Vector3::Zero();      ///< [m]
  double distance = 0.0;               ///< <= 0 where they meet [m]
};

/// The nearest places of two parts, one of them bounded: in the middle of all
/// points that are as low as the lowest one above a plane.
/// @param frames of the parts
[[nodiscard]] SolidGap find_gap(const PatchPart& A, const PatchPart& B,
                                const joints::PairBodies& frames);

}  // namespace limber::contact
