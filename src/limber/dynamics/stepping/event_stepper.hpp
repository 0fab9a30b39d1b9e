// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/relative_energy.hpp"
#include "limber/dynamics/integrators/make_integrator.hpp"
#include "limber/dynamics/monitors/contact_start_observer.hpp"
#include "limber/dynamics/monitors/event_observer.hpp"
#include "limber/dynamics/monitors/impact_steps.hpp"
#include "limber/dynamics/monitors/limit_crossing.hpp"
#include "limber/dynamics/stepping/damper_impulse.hpp"
#include "limber/dynamics/stepping/stop_steps.hpp"
#include "limber/dynamics/stepping/turn_counter.hpp"

namespace limber::dynamics {

/// Work of loads and energy dissipated since the start.
struct Losses {
  double work = 0.0;        ///< [J]
  double dissipated = 0.0;  ///< [J]
};

/// Takes steps, ends them at events of couplers and where contact begins or
/// ends, with a tolerance also where drives reach or leave their effort limit,
/// and updates their memory. Without switches and angles it adds no cost to a
/// step.
///
/// Equation   a switch's effect on a law is constant within a step, so that the
///            motion is smooth, and changes where the step is cut.
/// Source     events by the cubic through the values and rates at both ends of
///            a step [@hairer1993, sec. II.6], whose error is smaller than that
///            of the integrators.
/// Limits     a joint must rotate by less than half a turn a step; two sign
/// changes
///            of one switch within a step are not detected; after 32 successive
///            steps cut by events, further events are moved to a step's end.
class EventStepper {
 public:
  /// @param events new events are added here; stored by reference
  /// @param refinement of steps in impacts, see StepControl [-]
  EventStepper(const SystemModel& model, const SimulationSettings& settings,
               std::vector<Event>& events, double refinement = 1.0);

  /// Initialises before the first step, of about `h` [s]. Latches within reach
  /// close; for implicit schemes apply_damper_impulse() changes velocities.
  /// @returns its effect, if any
  std::optional<DamperImpulse> start(SystemState& state, double h);
  /// Prepares for the next step, of about h [s], at a discontinuity of a load.
  void cross_jump(const SystemState& state, double h);

  /// Advances `state` by h [s], to the time `end` [s], or by less if bodies
  /// strike each other, ignoring events. Either `take_back` or `settle` must
  /// follow.
  /// @throws NumericalError naming the body or coupler and the time; `state` is
  /// unchanged.
  void attempt(SystemState& state, double h, double end);
  /// Accepts the attempted step, cut at its events.
  /// @param nominal_h length of the steps that follow [s]
  /// @throws NumericalError as above, with the step reverted.
  void settle(SystemState& state, double nominal_h);
  /// Reverts the attempted step.
  void take_back(SystemState& state);
  /// Adds work and losses between two steps.
  void add_between_steps(const EnergyFlows& flows);

  /// Length of the attempted step [s].
  [[nodiscard]] double length() const { return h_; }
  /// Result of the last attempted step.
  [[nodiscard]] const StepResult& last() const { return last_; }
  /// State at its beginning; stored if there are switches or steps may be
  /// reverted (`settings.tolerance` > 0).
  [[nodiscard]] const SystemState& before() const { return before_; }
  [[nodiscard]] const Losses& losses() const { return losses_; }
  /// Energies of losses() by what they belong to, without that of an impulse at
  /// the start.
  [[nodiscard]] const EnergyFlows& flows() const { return flows_; }
  /// For terms at any state, until the next step.
  [[nodiscard]] SystemTerms& scratch() { return terms_; }
  /// Warns once of impacts that get longer steps than resolve them.
  void add_warnings(std::vector<std::string>& warnings);
  /// The pair whose impacts shorten steps; none if stops of joints do.
  [[nodiscard]] std::optional<std::size_t> impact_pair() const {
    if (is_at_stop_ || joined_.empty()) return std::nullopt;
    return impacts_.fastest();
  }
  /// Which pairs touch.
  [[nodiscard]] ContactStartObserver& touches() { return touches_; }

  /// Approximately those of the last step's end; null if an event is there,
  /// which invalidates them.
  [[nodiscard]] const SystemTerms* terms() const {
    return events_.size() == events_before_ ? &integrator_->terms() : nullptr;
  }

  /// Number of linear solves since the last call, including failed steps.
  [[nodiscard]] long take_solves() { return integrator_->take_solves(); }

  /// Discards cached factors and predictions: later steps then depend only on
  /// the state and on `exchange_memory`.
  void refresh() {
    integrator_->refresh();
    touches_.refresh();
  }
  /// Saves or restores the history, without the data that refresh() discards.
  void exchange_memory(Archive& archive, const SystemState& state);

 private:
  void advance(SystemState& state, double h, double end);
  std::optional<double> find_other_length(const SystemState& state);
  [[nodiscard]] UnresolvedMotion choose_motion(
      double h, const ContactStartObserver::Impact& impact) const;
  StepResult take_step(SystemState& state, double h, double end);
  [[nodiscard]] double find_touch_energy(std::size_t pair,
                                         const SystemState& state) const;
  void pass(const EventObserver::Crossing& crossing, SystemState& state,
            double h);
  void pass_all_at_end(SystemState& state, double h);
  // @throws NumericalError if a touch adds energy, or a leave is not genuine;
  // the step is reverted.
  void check_deep_touch(std::size_t index, SystemState& state);
  void check_leave(std::size_t index, SystemState& state);
  void check_missed_touch(std::size_t index, SystemState& state);
  int settle_touch(const ContactStartObserver::Crossing& crossing,
                   SystemState& state, double nominal_h);
  bool advance_to(double fraction, SystemState& state);
  void add_last();

  const SystemModel& model_;
  std::unique_ptr<Integrator> integrator_;
  SystemTerms terms_;  // of energies
  EventObserver observer_;
  ContactStartObserver touches_;
  ImpactSteps impacts_;
  LimitCrossing limits_;
  bool ends_at_limits_ = false;  // with a tolerance
  StopSteps stops_;
  TurnCounter turns_;
  std::vector<JoinedBodies> joined_;  // of each pair
  PairCommit commit_pairs_;
  std::vector<Event>& events_;
  bool is_implicit_ = false;
  bool conserves_impacts_ = false;
  bool keeps_before_ = false;
  bool is_at_stop_ = false;  // a stop, not a pair, shortened the last steps
  bool has_before_ = false;  // the attempted step can be taken back
  SystemState before_;
  double h_ = 0.0;                 // of the attempted step [s]
  std::size_t events_before_ = 0;  // count before it
  int cut_ = 0;                    // number of successive steps cut by events
  StepResult last_;
  Losses losses_;
  EnergyFlows last_flows_;
  EnergyFlows flows_;
};

}  // namespace limber::dynamics
