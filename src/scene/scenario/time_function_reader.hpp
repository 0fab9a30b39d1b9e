// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/time_function.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// Reads a load's `time` table: kind = "constant", "steps", "pulse",
/// "sinusoid", "sinusoids", "fourier" or "table", with the keys of that kind.
/// @param folder what files in it are relative to
/// @param warnings takes how far a Fourier series is from its table
[[nodiscard]] dynamics::TimeFunction read_time_function(
    TomlTable& table, const std::filesystem::path& folder,
    std::vector<std::string>& warnings);

}  // namespace limber::scene
