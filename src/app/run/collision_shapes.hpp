// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/results/pictures.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// The <collision> shapes of all rigid links, projectiles and obstacles,
/// whether they touch or not, for pictures.
/// @param model of this scene
[[nodiscard]] std::vector<results::BodySurface> find_collision_shapes(
    const scene::Scene& scene, const dynamics::SystemModel& model);

}  // namespace limber::app
