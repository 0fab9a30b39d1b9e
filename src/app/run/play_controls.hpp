// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/scene/build/scene.hpp"
#include "limber/view/play_page.hpp"

namespace limber::app {

/// The values of a scene that a playground lets its visitors change: of loads
/// (force, place, duration), the level, the step, the damping of links'
/// materials, contacts (restitution, friction), and how bodies move at the
/// start. Only values that its file gives.
[[nodiscard]] std::vector<view::PlayControl> list_controls(
    const scene::Scene& scene);

}  // namespace limber::app
