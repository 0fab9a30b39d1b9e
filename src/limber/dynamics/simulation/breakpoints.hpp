// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// A time that a step must end on.
struct Breakpoint {
  double time = 0.0;       ///< [s]
  bool is_jump = false;    ///< a load or its slope jumps
  bool is_output = false;  ///< an output time
  bool is_sample = false;  ///< a controller is sampled
};

/// Largest difference of times near t that are the same, except for the
/// round-off of sums of times like t and `start`: eight units in the last place
/// [s].
[[nodiscard]] double find_same_time(double t, double start);

/// The first time that is not the same as t: just after what jumps there [s].
[[nodiscard]] double find_time_after(double t);

/// All breakpoints after `start` [s], increasing; the last is the end. Times
/// that differ by round-off only are merged.
/// @param has_outputs whether outputs are breakpoints
/// @throws InputError for steps or samples of controllers below the resolution
/// of the time, or more than 1e7 samples.
[[nodiscard]] std::vector<Breakpoint> find_breakpoints(
    const SystemModel& model, double start, const SimulationSettings& settings,
    bool has_outputs = true);

/// The breakpoints of a run that it has not passed.
class BreakpointQueue {
 public:
  /// Steps to a tolerance do not end on outputs. @param start of the run [s]
  BreakpointQueue(const SystemModel& model, const SimulationSettings& settings,
                  double start)
      : start_(start),
        all_(find_breakpoints(model, start, settings,
                              settings.tolerance == 0.0)) {}

  [[nodiscard]] bool is_empty() const { return next_ == all_.size(); }
  [[nodiscard]] const Breakpoint& next() const {
    return is_stop_next_ ? stop_ : all_[next_];
  }
  /// The last one that was passed.
  [[nodiscard]] const Breakpoint& last() const { return all_[next_ - 1]; }
  /// Whether there are any until t [s].
  [[nodiscard]] bool has_until(double t) const {
    return !is_empty() && next().time <= t + find_same_time(t, start_);
  }
  /// Passes the next one.
  void pass();
  /// Adds one at t [s] if there is none, in place of one added before; kNever:
  /// none.
  void stop_at(double t);
  /// Saves or restores how many were passed, except those added.
  void exchange_memory(Archive& archive) { archive(next_); }

 private:
  double start_;  // [s]
  std::vector<Breakpoint> all_;
  std::size_t next_ = 0;
  Breakpoint stop_ = {.time = kNever};  // that was added
  bool is_stop_next_ = false;
};

/// Number of equal steps from one time to another, none longer than the
/// settings allow at the first, except for the rounding of times [s].
[[nodiscard]] long count_equal_steps(const SimulationSettings& settings,
                                     double from, double to);

/// Number of steps that the settings give between two times [s].
[[nodiscard]] double count_steps(const SimulationSettings& settings,
                                 double from, double until);

/// The longest step that the settings allow at time t [s].
[[nodiscard]] double find_longest_step(const SimulationSettings& settings,
                                       double t);
/// The longest step that they allow between two times [s].
[[nodiscard]] double find_longest_step(const SimulationSettings& settings,
                                       double from, double until);
/// The longest step that they allow at any time [s].
[[nodiscard]] double find_longest_step(const SimulationSettings& settings);

/// Times at which a simulation outputs its state [s]: the output times,
/// replaced by another breakpoint where they differ from it by round-off
/// only.
[[nodiscard]] std::vector<double> find_visited_times(
    const SystemModel& model, double start, const SimulationSettings& settings);

}  // namespace limber::dynamics
