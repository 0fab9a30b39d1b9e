// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::results {

/// A line of a letter: right and up from the start of the text's base line
/// [heights of capitals].
struct Stroke {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
};

/// The lines of a text in printable ASCII; other characters (UTF-8) are drawn
/// as '?'.
[[nodiscard]] std::vector<Stroke> find_strokes(const std::string& text);

/// [heights of capitals]
[[nodiscard]] double find_text_width(const std::string& text);

}  // namespace limber::results
