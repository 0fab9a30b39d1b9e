// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "scene/scenario.hpp"

namespace limber::scene {

/// Reads a scenario (TOML).
/// @throws InputError with every problem of the file, each with its line.
[[nodiscard]] Scenario read_scenario(const std::filesystem::path& file);

/// The same of a table that was parsed already.
/// @param file where it is from: for messages, and what its paths start from
[[nodiscard]] Scenario read_scenario(const toml::table& table,
                                     const std::filesystem::path& file);

}  // namespace limber::scene
