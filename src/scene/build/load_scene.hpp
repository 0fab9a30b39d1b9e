// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/build/scene.hpp"

namespace limber::scene {

/// Reads the scenario and its robot, and checks their consistency.
/// @throws InputError with every problem found.
[[nodiscard]] Scene load_scene(const std::filesystem::path& file,
                               const Overrides& overrides = {});

}  // namespace limber::scene
