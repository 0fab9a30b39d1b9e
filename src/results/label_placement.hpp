// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limber::results {

/// A point of a picture [pixels from the panel's lower left corner] and what
/// should be written beside it; empty: nothing.
struct LabelledPoint {
  double x = 0.0;
  double y = 0.0;
  std::string text;
};

/// Where a label goes: its end that is next to its point, half its height up.
struct LabelPlace {
  double x = 0.0;
  double y = 0.0;
  bool reaches_right = true;  ///< from there
};

/// Places labels beside their points one by one, in their order, so that none
/// covers a point, another label, the edge of the panel, or a horizontal line.
/// What finds no such place has none.
/// @param width, height of the panel [pixels]
/// @param lines heights of horizontal lines [pixels]
[[nodiscard]] std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<LabelledPoint>& points, double width, double height,
    const std::vector<double>& lines = {});

}  // namespace limber::results
