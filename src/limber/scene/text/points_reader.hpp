// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/scene/text/series_file.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// The points of a history: `times` and `values`, or a `file` of both, relative
/// to `folder`. Does not check their number or order.
[[nodiscard]] Series read_points(TomlTable& table,
                                 const std::filesystem::path& folder);

}  // namespace limber::scene
