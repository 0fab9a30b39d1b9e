// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

namespace limber::scene {

/// Bounds of a number, inclusive or exclusive.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();  ///< [its unit]
  double upper = std::numeric_limits<double>::infinity();   ///< [its unit]
  bool open_lower = false;
  bool open_upper = false;

  [[nodiscard]] bool contains(double value) const {
    return (open_lower ? value > lower : value >= lower) &&
           (open_upper ? value < upper : value <= upper);
  }
  [[nodiscard]] std::string text() const;
};
inline constexpr Range kPositive{0.0, std::numeric_limits<double>::infinity(),
                                 true, false};
inline constexpr Range kNonNegative{
    0.0, std::numeric_limits<double>::infinity(), false, false};

}  // namespace limber::scene
