// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "limber/common/progress.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"

namespace limber::dynamics {

/// Reports the progress of a run at most every millisecond, and ends the run if
/// the receiver requests it.
class ProgressPulse {
 public:
  /// @param settings stored by reference @param start of the run [s]
  ProgressPulse(const SimulationSettings& settings, double start)
      : settings_(settings), start_(start) {}
  void report_to(const Progress& progress) { progress_ = progress; }

  /// Between two steps, at t [s]. @throws Interrupted if an end is requested.
  void beat(double t);
  /// Within a step. @throws Interrupted three seconds after a request.
  void beat_within_step(double t);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double find_fraction(double t) const;
  void report(double t);
  [[noreturn]] void end(double t) const;

  const SimulationSettings& settings_;
  double start_;  // [s]
  Progress progress_;
  std::optional<Clock::time_point> last_;
  std::optional<Clock::time_point> requested_;
  std::string words_;  // of the request
};

}  // namespace limber::dynamics
