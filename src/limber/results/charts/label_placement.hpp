// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace limber::results {

/// A point of a picture [pixels from the panel's lower left corner] and its
/// label; empty: none.
struct LabelledPoint {
  double x = 0.0;  ///< [pixels]
  double y = 0.0;  ///< [pixels]
  std::string text;
};

/// Position of a label: its end next to the point, at half its height.
struct LabelPlace {
  double x = 0.0;             ///< [pixels]
  double y = 0.0;             ///< [pixels]
  bool reaches_right = true;  ///< from (x, y)
};

/// Places labels beside their points one by one, in order, so that none covers
/// a point, another label, the edge of the panel, or a horizontal line. Labels
/// without such a place are omitted.
/// @param width, height of the panel [pixels]
/// @param lines heights of horizontal lines [pixels]
[[nodiscard]] std::vector<std::optional<LabelPlace>> place_labels(
    const std::vector<LabelledPoint>& points, double width, double height,
    const std::vector<double>& lines = {});

}  // namespace limber::results
