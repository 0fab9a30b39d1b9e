// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/monitors/step_record.hpp"
#include "limber/dynamics/stepping/error_budget.hpp"
#include "limber/dynamics/system/oscillation.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Chooses the lengths of steps such that each has its allowed error.
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
  /// @param budget errors that steps may have
  /// @param longest step, the first one unless it is set [s]
  /// @param refinement factor of the limits, at most 1 [-]
  /// @param oscillations of loads and commands
  StepControl(const ErrorBudget& budget, double longest,
              double refinement = 1.0,
              std::vector<Oscillation> oscillations = {});

  /// Sets the length of the first step [s].
  void begin(double h) { h_ = std::min(h, longest_); }
  /// Length of the next step from `state`, at most `left` [s].
  [[nodiscard]] double propose(const SystemState& state, double left) const;
  /// The next step from `state`: it also shows what does not appear in its
  /// error, loads that are zero at both ends, or the same after a whole period,
  /// and touches.
  /// @param from the jump of loads before it, @param mark the one after it [s]
  /// @param touch the longest step that finds touches [s]
  [[nodiscard]] PlannedStep plan(const SystemState& state, double from,
                                 double mark, double touch) const;
  /// What steps of h [s] from t to `mark` [s] follow, as "load 'l' has a period
  /// of 0.1 s, which they follow"; empty if they are shorter than that needs.
  [[nodiscard]] std::string describe_oscillation(double t, double mark,
                                                 double h) const;
  /// Whether a step of length h [s] with the error `error` [m] is accepted;
  /// sets the next length.
  [[nodiscard]] bool accepts(double h, double error);
  /// Halves the step after a failure.
  void halve() { h_ *= 0.5; }

  /// Length of the next step [s].
  [[nodiscard]] double step() const { return h_; }
  /// Error that the next step may have [m].
  [[nodiscard]] double allowed() const { return budget_.allowed(); }
  /// Saves or restores the history.
  void exchange_memory(Archive& archive) {
    archive(h_, was_rejected_);
    budget_.exchange_memory(archive);
  }

 private:
  [[nodiscard]] const Oscillation* find_oscillation(double t,
                                                    double mark) const;

  ErrorBudget budget_;
  std::vector<Oscillation> oscillations_;
  double refinement_;     // [-]
  double longest_;        // [s]
  double most_rotation_;  // [rad]
  double h_;              // [s]
  bool was_rejected_ = false;
};

/// Length of a first step whose error is about `allowed` [m], infinite if
/// nothing accelerates [s]. It does not depend on the duration of the run, nor
/// on a common velocity of bodies that nothing ties to the world.
///
/// Equation   h = min(sqrt(allowed / a), cbrt(allowed / j)),
///            a the largest acceleration of a point of a body, j its rate of
///            change, of the motion continued for a thousandth of a body's size
///            or until accelerations have displaced a body by `allowed`
/// Source     as starting step sizes of [@hairer1993, sec. II.4], for
///            equations of second order
[[nodiscard]] double find_first_step(const SystemModel& model,
                                     const SystemState& state, double allowed);

}  // namespace limber::dynamics
