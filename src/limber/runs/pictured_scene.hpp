// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/results/scenery.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

/// A built scene with what pictures of it show.
struct PicturedScene {
  scene::BuiltScene built;
  /// The scenario's name, its text and those of its robots as they were before
  /// building, the settings applied to them, and shapes of rigid links
  /// (<visual> or else <collision>) and obstacles in the frames of their
  /// bodies.
  results::Scenery scenery;
};

/// scene::build_system, and the scenery; shapes that cannot be read are left
/// out with a warning among those of the scene.
[[nodiscard]] PicturedScene build_pictured(const scene::Scene& scene,
                                           const Reductions& reductions);

}  // namespace limber::runs
