// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "limber/common/records/archive.hpp"

namespace limber::dynamics {

/// What determined the length of a step.
enum class StepCause {
  given,        ///< the step of the settings, or the longest to a tolerance
  tolerance,    ///< its error
  rotation,     ///< of a body, with a tolerance
  oscillation,  ///< period of a load or command, with a tolerance
  breakpoint,   ///< an output, a jump of a load or a sample, with a tolerance
  impact,       ///< parts that resolve it
  event,        ///< it ends there
  failure,      ///< a longer step failed
};
inline constexpr std::size_t kStepCauses = 8;

/// "given", "tolerance", ...
[[nodiscard]] constexpr std::string_view to_string(StepCause cause) {
  constexpr std::array<std::string_view, kStepCauses> names = {
      "given",      "tolerance", "rotation", "oscillation",
      "breakpoint", "impact",    "event",    "failure"};
  return names.at(static_cast<std::size_t>(cause));
}

/// The length that a step is to have, and what determines it.
struct PlannedStep {
  double length = 0.0;  ///< [s]
  StepCause cause = StepCause::given;
};

/// Accepted steps and parts of steps of a run, by what determined their length.
struct StepRecord {
  struct Cause {
    double count = 0.0;
    double time = 0.0;  ///< simulated in them [s]
    double shortest = std::numeric_limits<double>::infinity();  ///< [s]
  };
  std::array<Cause, kStepCauses> causes = {};
  std::vector<double> of_body;  ///< count of those by a body's error
  std::vector<double> of_pair;  ///< count of those by a pair's impacts

  void add(StepCause cause, double h) {
    Cause& all = causes.at(static_cast<std::size_t>(cause));
    all.count += 1.0;
    all.time += h;
    if (h < all.shortest) all.shortest = h;
  }
  /// Saves or restores it for checkpoints.
  void exchange_memory(Archive& archive) {
    for (Cause& cause : causes) {
      archive(cause.count, cause.time, cause.shortest);
    }
    archive(of_body, of_pair);
  }
};

/// Estimated wall time of a run's steps by parts, in this process [s].
struct StepTimes {
  double contact = 0.0;   ///< forces of pairs, and times of events
  double newton = 0.0;    ///< all other work of the scheme
  double monitors = 0.0;  ///< energies, peaks and contacts of every step
  double outputs = 0.0;   ///< probes and energies at outputs
};

/// Measures the parts of every 37th step, so that it costs less than a
/// hundredth, and every output. Events at every 2^n-th step are counted as
/// often as they occur.
class StepTimer {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param step its number
  void begin(long step) {
    is_active_ = step % kStride == 0;
    if (is_active_) last_ = Clock::now();
  }
  [[nodiscard]] bool is_active() const { return is_active_; }
  /// Time since the last call or begin(); 0 of a step that is not measured [s].
  [[nodiscard]] double lap() {
    if (!is_active_) return 0.0;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> passed = now - last_;
    last_ = now;
    return passed.count();
  }
  void add_output(Clock::time_point begin) {
    const std::chrono::duration<double> passed = Clock::now() - begin;
    measured.outputs += passed.count();
  }
  /// Of steps that are measured, and of outputs.
  StepTimes measured;

  /// Of all steps.
  [[nodiscard]] StepTimes find_times() const {
    StepTimes all = measured;
    all.contact *= kStride;
    all.newton *= kStride;
    all.monitors *= kStride;
    return all;
  }

 private:
  static constexpr long kStride = 37;
  bool is_active_ = false;
  Clock::time_point last_;
};

}  // namespace limber::dynamics
