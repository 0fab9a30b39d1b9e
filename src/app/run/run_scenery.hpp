// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/results/scenery.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// Content of files for pictures, as they are now: the scenario's name, its
/// text and those of its robots, the settings applied to them, and the shapes
/// of rigid links, <visual> or else <collision>, in the frames of their links.
/// @param warnings one more if meshes cannot be read, which are left out
[[nodiscard]] results::Scenery read_scenery(const scene::Scene& scene,
                                            std::vector<std::string>& warnings);

/// Puts the shapes of links into the frames of their bodies, and adds those of
/// obstacles.
/// @param scenery read_scenery(scene)
void place_shapes(const scene::Scene& scene, const scene::BuiltScene& built,
                  results::Scenery& scenery);

}  // namespace limber::app
