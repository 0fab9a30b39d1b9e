// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace limber::results {

/// Cost and errors of one choice.
struct TradePoint {
  std::string group;  ///< shown by marker and colour: the level
  std::string label;  ///< written beside the point
  double cost = 0.0;  ///< wall time per simulated time [-]
  std::optional<double> displacement;  ///< relative error [-]
  std::optional<double> deformation;   ///< relative error [-]
};

/// Error over cost on logarithmic axes: a panel for the displacement and one
/// for the deformation, with the Pareto front. Points without an error, or with
/// error zero, are omitted.
/// @param reference_cost of the reference [-]
/// @param tolerance drawn as a line [-]
/// @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw_trade(const std::filesystem::path& file,
                                     const std::string& title,
                                     const std::vector<TradePoint>& points,
                                     double reference_cost,
                                     std::optional<double> tolerance);

/// Indices of the Pareto-optimal points in cost and error, by increasing cost.
/// @param costs in one unit [any]
/// @param errors one per point, in one unit [any]; points without are omitted
[[nodiscard]] std::vector<std::size_t> find_front(
    const std::vector<double>& costs,
    const std::vector<std::optional<double>>& errors);

}  // namespace limber::results
