// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/view/play_page.hpp"

namespace limber::app {

/// The values of a scene that users of a playground can change: of loads
/// (force, moment, place, duration), how bodies move at the start, contacts
/// (restitution, friction), the level, the modes that are kept, the damping of
/// links' materials, and the steps or the tolerance. Of keys of its files only
/// those that they give.
/// @param bodies of the scene's links
[[nodiscard]] std::vector<view::PlayControl> list_controls(
    const scene::Scene& scene, const std::vector<scene::ReducedPieces>& bodies);

}  // namespace limber::app
