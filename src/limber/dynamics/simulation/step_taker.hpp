// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

#include "limber/dynamics/simulation/progress_pulse.hpp"
#include "limber/dynamics/simulation/run_observers.hpp"
#include "limber/dynamics/stepping/event_stepper.hpp"
#include "limber/dynamics/stepping/step_control.hpp"
#include "limber/dynamics/stepping/work_budget.hpp"

namespace limber::dynamics {

/// Takes the steps to a breakpoint: equal ones, in parts where events cut them,
/// or, to a tolerance, as long as it allows. An attempt that fails is repeated
/// with half the length, up to ten times.
class StepTaker {
 public:
  /// Stores all by reference. @param start of the run [s]
  /// @param refinement see StepControl, at most 1 [-]
  StepTaker(const SystemModel& model, const SimulationSettings& settings,
            double start, double refinement, EventStepper& stepper,
            RunObservers& observers, SimulationStatistics& statistics);

  /// Plans the steps to a time, `mark` [s]. @param is_first of the run
  void plan(const SystemState& state, double mark, bool is_first);
  /// Where they end; NaN before the first [s].
  [[nodiscard]] double mark() const { return mark_; }
  /// One whole step.
  /// @param pulse beats after each part and each attempt
  /// @throws NumericalError as RunObservers::fail(); Interrupted, as the pulse.
  void take(SystemState& state, ProgressPulse& pulse);
  /// @throws NumericalError, see RunObservers. @param h that failed [s]
  [[noreturn]] void fail(const SystemState& state, double h,
                         const std::string& what);
  /// Whether the last step has ended there.
  [[nodiscard]] bool has_arrived() const { return part_ == parts_; }
  /// Of whole steps, the next or the last; 0 before the first [s].
  [[nodiscard]] double length() const { return h_; }
  void exchange_memory(Archive& archive);
  /// Whether steps are as long as a tolerance allows.
  [[nodiscard]] bool is_adaptive() const { return settings_.tolerance > 0.0; }

 private:
  void take_equal(SystemState& state, ProgressPulse& pulse);
  void take_free(SystemState& state, ProgressPulse& pulse);
  bool attempt_free(SystemState& state);
  bool attempt(SystemState& state, PlannedStep& step, double end);
  void halve(const SystemState& state, double h);
  void check_budget(const SystemState& state, double h);
  void check_most_steps(const SystemState& state);
  void count_fraction(const SystemState& state);
  [[nodiscard]] PlannedStep plan_free(const SystemState& state);
  [[nodiscard]] std::string describe_failure(const SystemState& state) const;

  const SystemModel& model_;
  const SimulationSettings& settings_;
  double start_;  // of the run [s]
  EventStepper& stepper_;
  RunObservers& observers_;
  SimulationStatistics& statistics_;
  StepControl control_;
  WorkBudget budget_;
  double origin_ = 0.0;  // where the steps to the mark began [s]
  double mark_ = std::numeric_limits<double>::quiet_NaN();
  long part_ = 0;        // number of the step to it
  long parts_ = 0;       // number of steps to it
  double h_ = 0.0;       // planned step [s]
  int depth_ = 0;        // number of current halvings of steps
  long fractions_ = 0;   // number of parts of halved steps so far
  std::string failure_;  // cause of the last halving
};

}  // namespace limber::dynamics
