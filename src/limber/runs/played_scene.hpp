// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "limber/dynamics/system/fidelity.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

/// Changes of a scene by a playground.
struct PlaySettings {
  scene::Overrides overrides = {};  ///< keys of its files, and the level
  /// The lowest that are kept of each body, > 0.
  std::optional<int> modes = {};
  std::optional<double> damping = {};  ///< of links' materials [-]
  double step_factor = 1.0;            ///< of all its steps, > 0 [-]
};

/// From lines PATH=VALUE: a key of `--set`, or `level`, `modes`, `damping`,
/// `steps` for the others.
/// @throws InputError for a line without '=', or a value out of bounds.
[[nodiscard]] PlaySettings parse_play_settings(const std::string& lines);

/// A scene whose flexible links have saved bodies in place of their meshes.
/// @param bodies files by name of link; of other modes are written beside them
/// @throws InputError as scene::load_scene, and for bodies that cannot be read.
[[nodiscard]] scene::Scene load_played_scene(
    const std::filesystem::path& scenario, const PlaySettings& settings,
    const std::map<std::string, std::filesystem::path>& bodies);

}  // namespace limber::runs
