// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include "limber/runs/compare/comparison.hpp"

namespace limber::app {

/// Draws trade.png and the overlay of the probes: for each level the run of
/// smallest error, and the reference.
/// @param tolerance drawn as a line [-]
void draw_comparison(const runs::Comparison& comparison,
                     const std::filesystem::path& folder,
                     std::optional<double> tolerance);

}  // namespace limber::app
