// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "limber/common/progress.hpp"

namespace limber::dynamics {

/// Reports the progress of a run every few milliseconds, independently of the
/// cost of its steps, and stores a request of the receiver to end the run.
class ProgressPulse {
 public:
  /// @param steps number so far
  [[nodiscard]] bool is_due(long steps) const {
    return steps - step_ >= stride_;
  }
  /// @param steps number so far
  /// @param fraction of the run that is done [-]
  void report(long steps, double fraction, const Progress& progress);

  /// Whether a requested end takes place now: at a step after which checkpoints
  /// may be saved (`is_even`), or a second after the request.
  [[nodiscard]] bool ends_here(bool is_even) const;
  /// Message of the request to end.
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point last_ = Clock::now();
  long step_ = 0;    // number at the last report
  long stride_ = 1;  // number of steps to the next
  std::optional<Clock::time_point> asked_;
  std::string words_;
};

}  // namespace limber::dynamics
