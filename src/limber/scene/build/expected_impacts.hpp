// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/flexbody/model/recipe.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Impacts of a flexible link to be expected from its contacts and the start of
/// the run, for automatic modes: one for each body that it may touch and whose
/// origin moves relative to that of the link.
///
/// Equation   k = 4/3 E* sqrt(R_e) of both materials, with R_e the contact's
///            `radius` or the other body's; or the contact's `stiffness`
/// Limits     Omits bodies that are set in motion later (by gravity, drives,
///            loads), and those of unknown curvature or material (meshes,
///            planes, other flexible links) unless the contact gives both. The
///            mass of a flexible link counts as infinite.
/// @param motions one per link, at the start
[[nodiscard]] std::vector<flexbody::ExpectedImpact> find_expected_impacts(
    const Scene& scene, const std::vector<LinkMotion>& motions, int link);

}  // namespace limber::scene
