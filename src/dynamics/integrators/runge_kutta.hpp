// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/equations.hpp"
#include "dynamics/step_result.hpp"

namespace limber::dynamics {

/// Explicit fourth-order Runge-Kutta on the group (Munthe-Kaas): the classic
/// tableau in the rotation vector of each step. Steps are added with their
/// round-off carried on to the next, so that short steps are as good as their
/// order says.
///
/// Source     Munthe-Kaas, "Runge-Kutta methods on Lie groups", BIT 38, 1998;
///            compensated summation: Knuth's two-sum.
/// Limits     stable only for h below about 2.8 / the highest frequency
///            (dynamics/explicit_limit.hpp).
class RungeKutta4 {
 public:
  explicit RungeKutta4(const SystemModel& model);

  /// Advances `state` by h, to the time `end` (given, so that no round-off of
  /// a sum puts a step's end beyond a load's edge).
  /// @throws NumericalError if the motion is no longer finite.
  StepResult step(SystemState& state, double h, double end);

  /// What it knows between steps, of which the last left `state`.
  void exchange_memory(Archive& archive, const SystemState& state);

  /// At the last evaluation of the last step.
  [[nodiscard]] const SystemTerms& terms() const { return terms_; }

 private:
  struct Slope {
    std::vector<Vector3> pdot, thetadot, vdot, wdot;
    VectorX etadot, etaddot;
    VectorX udot_H, uddot_H;  // of unreduced bodies
  };
  void calc_slope(const SystemState& at, const std::vector<Vector3>& theta,
                  Side side, Slope& slope);
  void displace(const SystemState& from, const Slope& slope, double h,
                double t);
  void advance(const SystemState& from, const Slope& slope, double h, double t);

  const SystemModel& model_;
  SystemTerms terms_;
  Accelerations accelerations_;
  std::array<Slope, 4> slopes_;
  std::vector<Vector3> theta_;  // rotation since the step's start
  SystemState stage_;
  // The state that the last step left, and what was lost in its sums. The
  // carry of a number that the caller has changed since is dropped.
  SystemState left_;
  SystemState carry_;
};

}  // namespace limber::dynamics
