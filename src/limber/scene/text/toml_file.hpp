// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <filesystem>

namespace limber::scene {

/// @throws InputError naming the file, and the line of a syntax error.
[[nodiscard]] toml::table parse_toml_file(const std::filesystem::path& file);

}  // namespace limber::scene
