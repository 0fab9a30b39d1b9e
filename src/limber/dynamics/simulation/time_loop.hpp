// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/control/saturation_observer.hpp"
#include "limber/dynamics/monitors/energy_growth_observer.hpp"
#include "limber/dynamics/monitors/impact_observer.hpp"
#include "limber/dynamics/monitors/peak_observer.hpp"
#include "limber/dynamics/monitors/step_observer.hpp"
#include "limber/dynamics/monitors/step_record.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/dynamics/simulation/controller_sampling.hpp"
#include "limber/dynamics/simulation/progress_pulse.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/dynamics/stepping/event_stepper.hpp"
#include "limber/dynamics/stepping/step_control.hpp"
#include "limber/dynamics/stepping/work_budget.hpp"
#include "limber/dynamics/system/oscillation.hpp"

namespace limber::dynamics {

/// Work of loads and energy dissipated since the start.
struct Losses {
  double work = 0.0;        ///< [J]
  double dissipated = 0.0;  ///< [J]
};

/// Advances a state in time: by steps of settings.step that end on every
/// breakpoint, or, to a tolerance, by steps of varying length that end on jumps
/// only. A step that fails is halved, up to ten times.
///
/// After every 256th step, and sooner in a large system, a run is refreshed:
/// it discards cached factors, and with a keeper makes a checkpoint. Which
/// steps these are depends on counts of work only. So a resumed run, which has
/// no factors either, is identical to the bit to one that was not interrupted.
class TimeLoop {
 public:
  /// Called with every output.
  using Visit = std::function<void(const SystemState&, const Losses&)>;
  /// Called at the start and at the end of every step.
  using Check = std::function<void(const SystemState&)>;

  /// @param state at the start
  /// @param refinement see StepControl, at most 1 [-]
  TimeLoop(const SystemModel& model, const SimulationSettings& settings,
           const SystemState& state, SimulationStatistics& statistics,
           double refinement, const Followed& followed = {}, Check check = {});

  /// Resumes from a checkpoint: sets `state` and the history. Outputs before it
  /// are not visited again.
  void resume(const Checkpoint& checkpoint, SystemState& state);

  /// @throws NumericalError naming the body or coupler and the time, and the
  /// likely cause; `state` is then that of the last good step. Interrupted, if
  /// `progress` does.
  void run(SystemState& state, const Visit& visit, const Progress& progress,
           const CheckpointKeeper& keeper);

  /// Advances `state` to t [s], at most the end time, and ends a step there;
  /// ends after the current step once `stops` returns true.
  /// @param stops called before every step
  /// @returns whether t was reached
  /// @throws NumericalError as run() does.
  bool run_to(double t, SystemState& state, const std::function<bool()>& stops);

  /// Takes samples that controllers with an ExternalLaw took at the present
  /// time again: their output has changed since.
  /// @throws NumericalError as run() does.
  void repeat_external_samples(SystemState& state);

  /// A checkpoint of now for resume(). Discards cached factors, so that both
  /// runs continue identically to the bit.
  [[nodiscard]] Checkpoint save(SystemState& state);

  [[nodiscard]] Losses losses() const;

  /// Adds the results of monitoring all steps so far: peaks, energy, contacts
  /// and warnings.
  void store(RunRecord& record);

 private:
  using Clock = std::chrono::steady_clock;

  // A breakpoint that run_to needs, if there was none.
  struct AddedBreakpoint {
    std::size_t index = 0;
    bool is_new = false;
  };

  AddedBreakpoint add_breakpoint(double t);
  void remove_breakpoint(const AddedBreakpoint& added);
  void take_step(SystemState& state, const Visit& visit,
                 const Progress& progress, const CheckpointKeeper& keeper);
  void enter_breakpoint(SystemState& state);
  void begin(SystemState& state);
  void take_samples(SystemState& state);
  void leave_breakpoint(const SystemState& state, const Visit& visit);
  void visit_output(const SystemState& state, const Losses& losses,
                    const Visit& visit);
  void take_planned_step(SystemState& state, const Progress& progress);
  void report_progress(const SystemState& state, const Progress& progress);
  void check_stop_within_step(const SystemState& state,
                              const Progress& progress);
  [[noreturn]] void end_here(const SystemState& state) const;
  [[nodiscard]] const Oscillation* find_oscillation(double t) const;
  [[nodiscard]] std::string describe_short_steps(
      const SystemState& state) const;
  // The length of a step, and what determines it.
  struct PlannedStep {
    double length = 0.0;  // [s]
    StepCause cause = StepCause::given;
  };
  [[nodiscard]] PlannedStep limit_free_step(const SystemState& state);
  [[nodiscard]] PlannedStep plan_free_step(const SystemState& state,
                                           double left);
  StepCause record_step(const PlannedStep& planned, double length);
  void time_contact(const SystemState& state, long solves);
  bool take_free_step(SystemState& state, const Visit& visit);
  template <typename Work>
  bool goes_through(const SystemState& state, double h, const Work& work);
  void halve(const SystemState& state, double h, const std::string& why);
  void count_fraction(const SystemState& state);
  void check_budget(const SystemState& state, double h);
  void visit_within(const SystemState& begin, const SystemState& state,
                    const Losses& before, const Visit& visit);
  void count_step(const StepResult& since);
  [[nodiscard]] bool is_look_due(const SystemState& state, long steps) const;
  void watch_step(const SystemState& state, std::size_t events_before);
  void inspect(const SystemState& state);
  void check(const SystemState& state);
  [[nodiscard]] bool is_refresh_due() const;
  void refresh();
  void hold_checkpoint(SystemState& state, const CheckpointKeeper& keeper);
  void keep_checkpoint(const CheckpointKeeper& keeper);
  [[nodiscard]] double find_fraction(double t) const;
  void exchange_memory(Archive& archive, SystemState& state);
  [[nodiscard]] bool is_sound(const SystemState& state);
  [[noreturn]] void fail(const SystemState& state, double h,
                         const std::string& what);
  [[nodiscard]] std::string describe_failure(const SystemState& state) const;
  [[nodiscard]] bool is_adaptive() const { return settings_.tolerance > 0.0; }

  const SystemModel& model_;
  const SimulationSettings& settings_;
  SimulationStatistics& statistics_;
  double start_;  // [s]
  bool starts_with_output_;
  std::vector<Breakpoint> breakpoints_;
  std::vector<double> outputs_;  // of steps to a tolerance
  double refinement_;            // see StepControl [-]
  std::vector<Oscillation> oscillations_;
  EventStepper stepper_;
  ControllerSampling sampling_;
  SaturationObserver saturation_;
  StepControl control_;
  PeakObserver peaks_;
  StepObserver step_observer_;
  ImpactObserver contacts_;
  Check check_;
  WorkBudget budget_;
  SystemTerms terms_;  // at the start
  EnergyFlows jumps_;  // between two steps
  StepRecord steps_;
  StepTimer timer_;
  SystemState within_;
  SystemState sound_;  // at the last look at an energy not too much

  // Progress of the run.
  bool has_started_ = false;
  std::size_t next_ = 0;      // next breakpoint
  long part_ = 0;             // number of the step to it
  long parts_ = 0;            // number of steps to it, 0: not yet known
  double origin_ = 0.0;       // the last breakpoint [s]
  double h_ = 0.0;            // planned step [s]
  bool at_jump_ = false;      // a load jumped at the last breakpoint
  bool inputs_jump_ = false;  // where the current step ends
  int depth_ = 0;             // number of current halvings of steps
  long fractions_ = 0;        // number of parts of halved steps so far
  std::string failure_;       // cause of the last halving
  std::string clash_;         // message on initial velocities against dampers
  std::size_t output_ = 0;    // next of outputs_
  std::size_t visits_ = 0;    // number of outputs so far
  long refreshed_steps_ = 0;  // counts at the last refresh
  long refreshed_solves_ = 0;
  std::optional<Checkpoint> checkpoint_;  // the last, until it is kept
  Clock::time_point kept_;                // time of the last checkpoint
  ProgressPulse pulse_;
};

}  // namespace limber::dynamics
