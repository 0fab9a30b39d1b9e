// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "dynamics/checkpoint.hpp"
#include "dynamics/energy_watch.hpp"
#include "dynamics/landmarks.hpp"
#include "dynamics/marcher.hpp"
#include "dynamics/peak_watch.hpp"
#include "dynamics/run_record.hpp"
#include "dynamics/step_audit.hpp"
#include "dynamics/step_control.hpp"
#include "dynamics/work_budget.hpp"

namespace limber::dynamics {

/// What the loads and the dampers did since the start.
struct Losses {
  double work = 0.0;        ///< [J]
  double dissipated = 0.0;  ///< [J]
};

/// Carries a state along a timeline: steps of settings.step that end on every
/// landmark, or of any length to a tolerance that end on jumps alone. A step
/// that does not go through is halved, up to ten times.
///
/// A checkpoint may be made after every 256th step. There the run drops what it
/// only keeps to be faster, so that one that goes on from a checkpoint is the
/// same to the bit.
class Driver {
 public:
  /// Called with every output.
  using Visit = std::function<void(const SystemState&, const Losses&)>;

  /// @param state at the start @param refinement of all that limits steps to a
  /// tolerance but their errors, at most 1 (StepControl)
  Driver(const SystemModel& model, const SimulationSettings& settings,
         const SystemState& state, SimulationStatistics& statistics,
         double refinement, const Followed& followed = {});

  /// Goes on from a checkpoint: `state` and all that was known then. Outputs
  /// that were visited before are not visited again.
  void resume(const Checkpoint& checkpoint, SystemState& state);

  /// @throws NumericalError naming the body or coupler and the time, and the
  /// likely cause; `state` is then that of the last good step. Interrupted, if
  /// `progress` does.
  void run(SystemState& state, const Visit& visit, const Progress& progress,
           const CheckpointKeeper& keeper);

  /// Adds what was seen over all steps up to where the run is: peaks, energy
  /// and warnings.
  void tell(RunRecord& record);

 private:
  using Clock = std::chrono::steady_clock;

  void enter_mark(SystemState& state);
  void leave_mark(const SystemState& state, const Visit& visit);
  void take_planned_step(SystemState& state);
  bool take_free_step(SystemState& state, const Visit& visit);
  template <typename Work>
  bool goes_through(const SystemState& state, double h, const Work& work);
  void halve(const SystemState& state, double h, const std::string& why);
  void count_share(const SystemState& state);
  void check_budget(const SystemState& state, double h) const;
  void visit_within(const SystemState& begin, const SystemState& state,
                    const Losses& before, const Visit& visit);
  void count_step(const StepResult& since);
  void watch_step(const SystemState& state, std::size_t events);
  void inspect(const SystemState& state);
  void keep_checkpoint(SystemState& state, const CheckpointKeeper& keeper,
                       bool is_last);
  [[nodiscard]] double find_share(double t) const;
  void tell_progress(const SystemState& state, const Progress& progress);
  [[nodiscard]] bool ends_here(bool is_even) const;
  void exchange_memory(Archive& archive, SystemState& state);
  [[noreturn]] void fail(const SystemState& state, double h,
                         const std::string& what) const;
  [[nodiscard]] std::string describe_trouble(const SystemState& state) const;
  [[nodiscard]] bool is_adaptive() const { return settings_.tolerance > 0.0; }
  [[nodiscard]] Losses losses() const;

  const SystemModel& model_;
  const SimulationSettings& settings_;
  SimulationStatistics& statistics_;
  double start_;
  bool starts_with_output_;
  std::vector<Landmark> marks_;
  std::vector<double> outputs_;  // of steps to a tolerance
  double refinement_;
  Marcher marcher_;
  StepControl control_;
  EnergyWatch watch_;
  PeakWatch peaks_;
  StepAudit audit_;
  WorkBudget budget_;
  SystemTerms terms_;  // of the energy
  SystemState within_;

  // Where the run is.
  bool has_started_ = false;
  std::size_t mark_ = 0;    // next landmark
  long part_ = 0;           // of the steps to it
  long parts_ = 0;          // steps to it, 0: not yet known
  double origin_ = 0.0;     // the landmark before [s]
  double h_ = 0.0;          // planned step [s]
  bool at_jump_ = false;    // there, a load jumped
  int depth_ = 0;           // how often steps are halved now
  long shares_ = 0;         // of halved steps, so far
  std::string trouble_;     // why the last step was halved
  std::string clash_;       // of velocities at the start
  std::size_t output_ = 0;  // next of outputs_
  Clock::time_point kept_;  // when the last checkpoint was

  // Progress: when and at which step it was told last, after how many it is
  // again, and when and in which words it asked for the end.
  Clock::time_point told_;
  long told_step_ = 0;
  long stride_ = 1;
  std::optional<Clock::time_point> asked_;
  std::string words_;
};

/// When a Driver visits: the output times, those that agree with other
/// landmarks but for round-off as the landmarks have them [s].
[[nodiscard]] std::vector<double> find_visited_times(
    const SystemModel& model, double start, const SimulationSettings& settings);

}  // namespace limber::dynamics
