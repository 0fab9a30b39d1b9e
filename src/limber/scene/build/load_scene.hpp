// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/build/scene.hpp"
#include "limber/scene/build/scene_robots.hpp"

namespace limber::scene {

/// Reads the scenario and its robot, and checks their consistency.
/// @param known robots that need not be read again; null: read all
/// @throws InputError with every problem found.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file,
                               const Overrides& overrides = {},
                               KnownRobots* known = nullptr);

/// `by` in place of what `own` has: key by key of settings and [basis].
[[nodiscard]] Overrides merge(Overrides own, const Overrides& by);

}  // namespace limber::scene
