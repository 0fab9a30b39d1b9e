// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limber/dynamics/control/saturation_observer.hpp"
#include "limber/dynamics/monitors/impact_observer.hpp"
#include "limber/dynamics/monitors/peak_observer.hpp"
#include "limber/dynamics/monitors/step_observer.hpp"
#include "limber/dynamics/monitors/step_record.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/stepping/event_stepper.hpp"

namespace limber::dynamics {

/// All that observes the steps and outputs of a run. It ends a run whose motion
/// blows up, and knows from a state before that why a run fails.
class RunObservers {
 public:
  /// Called with every output.
  using Visit = std::function<void(const SystemState&, const Losses&)>;
  /// Called at the start and at the end of every step.
  using Check = std::function<void(const SystemState&)>;

  /// Stores `model`, `settings`, `stepper` and `statistics` by reference.
  /// @param start of the run @param stepper that takes its steps
  RunObservers(const SystemModel& model, const SimulationSettings& settings,
               const SystemState& start, const Followed& followed, Check check,
               EventStepper& stepper, SimulationStatistics& statistics);

  /// Before the first step, of h [s]. @param lost in an impulse just before [J]
  void start(const SystemState& state, double h, double lost);
  /// Controllers were sampled after a step of h [s].
  void include_samples(const SystemState& state, double h) {
    saturation_.include(state, h, statistics_.warnings);
  }
  /// A load or an input jumps at the end of the last step.
  void cross_jump(const SystemState& state) { peaks_.cross_jump(state); }
  /// The next step begins at that jump.
  void leave_jump(const SystemState& state) {
    step_observer_.cross_jump(state, stepper_.flows());
  }
  /// The end of a step, or of a part of one, that began at a time [s].
  /// @returns what determined its length
  StepCause include(const SystemState& state, const PlannedStep& planned,
                    double begin);
  /// The end of a whole step of h [s], or, with 0, the start of the run.
  /// @throws NumericalError if the motion blows up, as fail(), and of the check
  void check(const SystemState& state, double h);
  /// @throws NumericalError of `what` and its likely cause.
  /// @param failed the length that failed @param h that of whole steps [s]
  [[noreturn]] void fail(const SystemState& state, double failed, double h,
                         const std::string& what);

  void report_to(const Visit& visit) { visit_ = visit; }
  void visit_start(const SystemState& state);
  void visit(const SystemState& state) { visit(state, stepper_.losses()); }
  /// Outputs within the last step, to a tolerance. @param before at its begin
  void visit_within(const SystemState& state, const Losses& before);
  /// Number of outputs so far.
  [[nodiscard]] std::size_t visits() const { return visits_; }

  /// Measures the parts of a step, except that of monitors.
  [[nodiscard]] StepTimer& timer() { return timer_; }
  /// Separates the time of contacts in a step of so many linear solves.
  void separate_contact(const SystemState& state, long solves);

  /// Adds the results of all steps so far, and warnings.
  void store(RunRecord& record);
  /// Saves or restores all but the log.
  void exchange_memory(Archive& archive);
  /// See PeakObserver.
  [[nodiscard]] std::vector<double> take_log() { return peaks_.take_log(); }
  /// After exchange_memory(). @param log of all checkpoints
  void resume(const SystemState& state, const std::vector<double>& log);

 private:
  [[nodiscard]] bool is_look_due(const SystemState& state, long steps) const;
  void inspect(const SystemState& state, double h);
  [[nodiscard]] bool is_sound(const SystemState& state);
  void visit(const SystemState& state, const Losses& losses);

  const SystemModel& model_;
  const SimulationSettings& settings_;
  EventStepper& stepper_;
  SimulationStatistics& statistics_;
  Visit visit_;
  Check check_;
  SaturationObserver saturation_;
  PeakObserver peaks_;
  StepObserver step_observer_;
  ImpactObserver contacts_;
  StepRecord steps_;
  StepTimer timer_;
  SystemState sound_;       // at the last look at an energy not too much
  SystemState beside_;      // one that is not of the run
  std::string clash_;       // message on initial velocities against dampers
  std::size_t output_ = 0;  // next within a step
  std::size_t visits_ = 0;
};

}  // namespace limber::dynamics
