// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/results/scenery.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// The scenario's name, and the texts of its file and its robots', as they are
/// now, and the settings that were applied to them.
/// @throws InputError if one cannot be read.
[[nodiscard]] results::Scenery read_scenery_texts(const scene::Scene& scene);

/// Adds the shapes of rigid links, <visual> or else <collision>, and of
/// obstacles. Meshes are left out.
void add_shapes(const scene::Scene& scene, const scene::BuiltScene& built,
                results::Scenery& scenery);

}  // namespace limber::app
