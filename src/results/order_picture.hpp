// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace limber::results {

struct OrderLine {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  ///< one an x; only those above zero are drawn
};

/// Errors over what they should fall with, both logarithmic; through the first
/// point of each line goes a thin one of the expected slope.
/// @returns an empty string, or why there is no picture.
[[nodiscard]] std::string draw_order(const std::filesystem::path& file,
                                     const std::string& title,
                                     const std::string& x_label,
                                     const std::string& y_label, double slope,
                                     const std::vector<OrderLine>& lines);

}  // namespace limber::results
