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

  /// Whether a requested end takes place now: at a step after which checkpoints
  /// may be saved (`is_even`), or a second after the request.
  [[nodiscard]] bool ends_here(bool is_even) const;
  /// Whether it takes place within a step, of which there is no checkpoint:
  /// three seconds after the request.
  [[nodiscard]] bool ends_within_step() const;
  /// Message of the request to end.
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool waits_longer_than(std::chrono::seconds time) const;

  std::optional<Clock::time_point> last_;
  std::optional<Clock::time_point> asked_;
  std::string words_;
};

}  // namespace limber::dynamics
