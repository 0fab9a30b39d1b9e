// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Chooses the lengths of steps such that their errors are equal.
///
/// Equation   the error of a step of a second-order scheme grows as h^3, so
///            that the next step is h cbrt(0.8 allowed / error)
/// Source     error per step [@hairer1993, sec. II.4]. For a given sum of the
///            errors, steps with equal errors are the fewest: the sum is
///            int C h^2 dt, their number int dt / h, smallest for equal C h^3.
/// Limits     A step grows by at least half or not at all, so that implicit
///            schemes keep their factors. No body rotates by more than 1 rad a
///            step. Where that or `longest` limits steps, their length does not
///            depend on the error: a pass with a smaller error scales both
///            limits by `refinement`, in proportion to its other steps.
class StepControl {
 public:
  /// @param allowed error of a step [m]
  /// @param span duration of the run [s]
  /// @param longest step [s]
  /// @param refinement factor of the limits, at most 1 [-]
  StepControl(double allowed, double span, double longest,
              double refinement = 1.0);

  /// Length of the next step from `state`, at most `left` [s].
  [[nodiscard]] double propose(const SystemState& state, double left) const;
  /// Whether a step of length h [s] with the error `error` [m] is accepted;
  /// sets the next length.
  [[nodiscard]] bool accepts(double h, double error);
  /// Halves the step after a failure.
  void halve() { h_ *= 0.5; }

  /// Length of the next step [s].
  [[nodiscard]] double step() const { return h_; }
  /// Saves or restores the history.
  void exchange_memory(Archive& archive) { archive(h_, was_rejected_); }

 private:
  double allowed_;    // [m]
  double longest_;    // [s]
  double most_turn_;  // [rad]
  double h_;          // [s]
  bool was_rejected_ = false;
};

}  // namespace limber::dynamics
