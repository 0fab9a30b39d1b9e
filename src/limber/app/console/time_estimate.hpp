// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "limber/common/duration.hpp"

namespace limber::app {

/// Predicts how long work takes from its first seconds.
///
/// Equation   left = (now - t_0) (1 - f) / (f - f_0), with f_0 the fraction
///            done when it began or last restarted
class TimeEstimate {
 public:
  /// Work longer than this is announced [s].
  static constexpr double kLong = 60.0;
  /// Time measured before a prediction [s].
  static constexpr double kPiece = 2.0;

  /// Records a report of progress.
  /// @param now wall time [s]
  void note(std::string_view what, double fraction, double now);

  /// Remaining time [s]; none before anything is measured.
  [[nodiscard]] std::optional<double> left() const;

  /// A line about work that will be long, predicted from its first seconds or
  /// by its description (limber::with_duration), once for each work; else
  /// empty.
  [[nodiscard]] std::string take_announcement();

  [[nodiscard]] const std::string& what() const { return what_; }

 private:
  std::string what_;
  double start_ = 0.0;  // wall time [s]
  double first_ = 0.0;  // fraction at the start
  double now_ = 0.0;
  double fraction_ = 0.0;
  std::set<std::string, std::less<>> announced_;
};

}  // namespace limber::app
