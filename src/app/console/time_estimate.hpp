// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "common/duration.hpp"

namespace limber::app {

/// Foretells how long work takes from its first seconds.
///
/// Equation   left = (now - t_0) (1 - f) / (f - f_0), where f_0 of the work was
///            done when it began or was last seen to begin anew
class TimeEstimate {
 public:
  /// Work longer than this is told of [s].
  static constexpr double kLong = 60.0;
  /// What is measured of it first [s].
  static constexpr double kPiece = 2.0;

  /// Takes note of a report of progress.
  /// @param now wall time [s]
  void note(std::string_view what, double fraction, double now);

  /// What is left [s]; none before anything is measured.
  [[nodiscard]] std::optional<double> left() const;

  /// A line on work that will be long, by its first seconds or by words that
  /// foretell it (limber::foretell), once for each work; else empty.
  [[nodiscard]] std::string take_announcement();

  [[nodiscard]] const std::string& what() const { return what_; }

 private:
  std::string what_;
  double start_ = 0.0;  // wall time [s]
  double first_ = 0.0;  // fraction at the start
  double now_ = 0.0;
  double fraction_ = 0.0;
  std::set<std::string, std::less<>> told_;
};

}  // namespace limber::app
