// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/scenario.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// Reads a [[drive]]. Its name is that of its joint or tendon if it has none.
/// @param folder what files in it are relative to
[[nodiscard]] DriveSpec read_drive(TomlTable& table,
                                   const std::filesystem::path& folder);

/// Reads a [[release]] of a latch that `releases` does not hold yet.
void read_release(TomlTable& table, std::map<std::string, double>& releases);

}  // namespace limber::scene
