// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "app/comparison.hpp"

namespace limber::app {

/// "1.2 %"; "none" without a value. @param share [-]
[[nodiscard]] std::string to_percent(std::optional<double> share);

[[nodiscard]] Json to_json(const ComparedRun& run);
[[nodiscard]] Json to_json(const Comparison& comparison);

/// A table with a line a run, the reference last.
[[nodiscard]] std::string to_text(const Comparison& comparison);

/// Draws trade.png and the overlay of the probes: of each level the run with
/// the smallest error, and the reference.
/// @param tolerance drawn as a line [-]
void draw_comparison(const Comparison& comparison,
                     const std::filesystem::path& folder,
                     std::optional<double> tolerance);

}  // namespace limber::app
