// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Chooses steps such that their errors add up to no more than a tolerance.
///
/// Equation   a step of length h may err by tolerance h / span; the error of a
///            second-order scheme's step grows as h^3, so that the next one is
///            h sqrt(0.8 tolerance h / (span error))
/// Source     error per unit step [@hairer1993, sec. II.4]
/// Limits     A step is not made longer by less than half, so that implicit
///            schemes keep their factors. No body turns by more than 1 rad.
class StepControl {
 public:
  /// @param tolerance [m] @param span of time in which errors add up [s]
  /// @param longest step [s]
  StepControl(double tolerance, double span, double longest);

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
  double tolerance_rate_;  // [m/s]
  double longest_;
  double h_;
  bool was_rejected_ = false;
};

}  // namespace limber::dynamics
