// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limber::results {

struct OrderLine {
  std::string name;
  std::vector<double> x;  ///< [as x_label]
  std::vector<double> y;  ///< one per x; only those above zero are drawn
                          ///< [as y_label]
};

/// Errors over a parameter on logarithmic axes; a thin line of the expected
/// slope [-] passes through the first point of each line.
/// @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw_order(const std::filesystem::path& file,
                                     const std::string& title,
                                     const std::string& x_label,
                                     const std::string& y_label, double slope,
                                     const std::vector<OrderLine>& lines);

}  // namespace limber::results
