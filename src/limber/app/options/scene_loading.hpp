// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// scene::load_scene, and prints the scenario's notes, before an analysis that
/// may fail because of their content.
[[nodiscard]] scene::Scene load_with_notes(const std::filesystem::path& file,
                                           const scene::Overrides& overrides);

/// Prints the notes of a built scene that load_with_notes has not printed.
/// @param notes scene::BuiltScene::notes
void print_more_notes(const scene::Scene& scene,
                      const std::vector<std::string>& notes);

}  // namespace limber::app
