// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Chooses steps that all err alike.
///
/// Equation   the error of a second-order scheme's step grows as h^3, so that
///            the next one is h cbrt(0.8 allowed / error)
/// Source     error per step [@hairer1993, sec. II.4]. Of all steps whose
///            errors have one sum, those that err alike are the fewest: the sum
///            is int C h^2 dt, their number int dt / h, which is least for
///            equal C h^3.
/// Limits     A step is not made longer by less than half, so that implicit
///            schemes keep their factors. No body turns by more than 1 rad.
///            Where that or `longest` holds steps back, errors say nothing of
///            their length: a run that is to err less shortens both limits by
///            `refinement`, as it does steps that errors hold back.
class StepControl {
 public:
  /// @param allowed error of a step [m] @param span of time that steps have to
  /// pass [s] @param longest step [s] @param refinement at most 1
  StepControl(double allowed, double span, double longest,
              double refinement = 1.0);

  /// Length of the next step from `state`, at most `left` [s].
  [[nodiscard]] double propose(const SystemState& state, double left) const;
  /// Whether a step of length h [s] that erred by `error` [m] counts; and
  /// plans the next.
  [[nodiscard]] bool accepts(double h, double error);
  /// A step did not go through at all.
  void halve() { h_ *= 0.5; }

  [[nodiscard]] double step() const { return h_; }
  void exchange_memory(Archive& archive) { archive(h_, was_rejected_); }

 private:
  double allowed_;  // [m]
  double longest_;
  double most_turn_;  // [rad]
  double h_;
  bool was_rejected_ = false;
};

}  // namespace limber::dynamics
