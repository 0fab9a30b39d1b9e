// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Reads a scenario (TOML).
/// @throws InputError with every problem of the file, each with its line.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file);

/// The same from a parsed table.
/// @param file its source: for messages, and as base of relative paths
[[nodiscard]] Scenario read_scenario(const toml::table& table,
                                     const std::filesystem::path& file);

}  // namespace limber::scene
