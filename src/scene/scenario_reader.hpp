// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scene/scenario.hpp"

namespace limber::scene {

/// Reads a scenario (TOML).
/// @throws InputError with every problem of the file, each with its line.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file);

}  // namespace limber::scene
