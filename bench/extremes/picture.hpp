// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "judge.hpp"
#include "maps.hpp"

namespace limber::bench {

/// A map's cells of one integrator, in rows of y.
using Verdicts = std::vector<std::vector<Verdict>>;

/// Draws a map, a panel an integrator, a coloured square a cell. In a square
/// stands its error in percent of the range, or a letter.
/// @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw(const Map& map,
                               const std::vector<Verdicts>& verdicts,
                               const std::filesystem::path& file);

}  // namespace limber::bench
