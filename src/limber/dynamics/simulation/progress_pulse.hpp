// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "limber/common/progress.hpp"

namespace limber::dynamics {

/// Reports the progress of a run at most every millisecond, and stores a
/// request of the receiver to end the run.
class ProgressPulse {
 public:
  /// At the first call, and a millisecond after each report.
  [[nodiscard]] bool is_due() const;
  /// @param fraction of the run that is done [-]
  void report(double fraction, const Progress& progress);

  /// Whether an end is requested, which takes place between two steps.
  [[nodiscard]] bool ends_here() const { return requested_.has_value(); }
  /// Whether it takes place within a step: three seconds after the request.
  [[nodiscard]] bool ends_within_step() const;
  /// Message of the request to end.
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Clock::time_point> last_;
  std::optional<Clock::time_point> requested_;
  std::string words_;
};

}  // namespace limber::dynamics
