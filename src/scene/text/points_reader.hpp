// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scene/series_file.hpp"
#include "scene/toml_table.hpp"

namespace limber::scene {

/// The points of a history: `times` and `values`, or a `file` of both, relative
/// to `folder`. Neither their number nor their order is checked.
[[nodiscard]] Series read_points(TomlTable& table,
                                 const std::filesystem::path& folder);

}  // namespace limber::scene
