// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/dynamics/simulation/checkpoint.hpp"
#include "limber/dynamics/simulation/controller_sampling.hpp"
#include "limber/dynamics/simulation/progress_pulse.hpp"
#include "limber/dynamics/simulation/run_observers.hpp"
#include "limber/dynamics/simulation/step_taker.hpp"
#include "limber/dynamics/stepping/event_stepper.hpp"

namespace limber::dynamics {

/// Advances a state in time, step by step, from breakpoint to breakpoint:
/// controllers are sampled there, and forces may jump.
///
/// After every 256th step, and sooner in a large system, a run is refreshed:
/// it discards cached factors, and with a keeper makes a checkpoint. Which
/// steps these are depends on counts of work only. So a resumed run, which has
/// no factors either, is identical to the bit to one that was not interrupted.
class TimeLoop {
 public:
  using Visit = RunObservers::Visit;
  using Check = RunObservers::Check;

  /// @param state at the start
  /// @param refinement see StepControl, at most 1 [-]
  TimeLoop(const SystemModel& model, const SimulationSettings& settings,
           const SystemState& state, SimulationStatistics& statistics,
           double refinement, const Followed& followed = {}, Check check = {});

  /// Resumes from a checkpoint: sets `state` and the history. Outputs before it
  /// are not visited again. @param log of all checkpoints
  void resume(Archive& archive, const std::vector<double>& log,
              SystemState& state);

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

  /// Saves the run for resume(). Discards cached factors, so that both runs
  /// continue identically to the bit.
  void save(Archive& archive, SystemState& state);

  [[nodiscard]] Losses losses() const { return stepper_.losses(); }

  /// Adds the results of observing all steps so far, and warnings.
  void store(RunRecord& record) { observers_.store(record); }

 private:
  using Clock = std::chrono::steady_clock;

  void begin(SystemState& state);
  void take_step(SystemState& state);
  void enter_breakpoint(SystemState& state);
  void leave_breakpoint(SystemState& state);
  bool take_samples(SystemState& state);
  [[nodiscard]] bool is_refresh_due() const;
  void refresh();
  void hold_checkpoint(SystemState& state);
  void keep_checkpoint();
  void exchange_memory(Archive& archive, SystemState& state);

  const SystemModel& model_;
  SimulationStatistics& statistics_;
  EventStepper stepper_;
  RunObservers observers_;
  BreakpointQueue breakpoints_;
  StepTaker steps_;
  ControllerSampling sampling_;
  ProgressPulse pulse_;
  CheckpointKeeper keeper_;

  bool has_started_ = false;
  bool at_jump_ = false;      // a load jumped at the last breakpoint
  long refreshed_steps_ = 0;  // counts at the last refresh
  long refreshed_solves_ = 0;
  std::optional<Checkpoint> checkpoint_;   // the last, until it is kept
  Clock::time_point kept_ = Clock::now();  // time of the last checkpoint
};

}  // namespace limber::dynamics
