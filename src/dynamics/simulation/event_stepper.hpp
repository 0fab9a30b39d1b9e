// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "dynamics/damper_impulse.hpp"
#include "dynamics/event_watch.hpp"
#include "dynamics/stepper.hpp"

namespace limber::dynamics {

/// Takes steps, ends them where something happens at a coupler, and keeps what
/// couplers remember. Without switches and angles it adds nothing to a step.
///
/// Equation   what a switch does to a law is held through a step, so that the
///            motion is smooth within one, and changes where the step is cut.
/// Source     events by the cubic through the values and rates at both ends of
///            a step [@hairer1993, sec. II.6], whose error is smaller than that
///            of the integrators.
/// Limits     a joint turns less than half a turn a step; of two changes of
///            sign of one switch within a step neither is seen; after 32 steps
///            that were cut in a row, what happens is noted at a step's end.
class Marcher {
 public:
  /// @param events what happens is added here
  Marcher(const SystemModel& model, const SimulationSettings& settings,
          std::vector<Event>& events);

  /// Before the first step, which will be about `h` long [s]. Latches within
  /// reach close; before implicit steps velocities are brought onto what
  /// dampers allow. @returns what that took, if it was called for
  std::optional<DamperImpulse> start(SystemState& state, double h);
  /// After a step that ended where a load jumps.
  void cross_jump(const SystemState& state, double h);

  /// Advances `state` by h [s], to the time `end` [s], as if nothing happened
  /// within. Then either `take_back` or `settle`.
  /// @throws NumericalError naming the body or coupler and the time; `state` is
  /// unchanged.
  void attempt(SystemState& state, double h, double end);
  /// @throws NumericalError as above, with the step taken back.
  void settle(SystemState& state, double nominal_h);
  void take_back(SystemState& state);

  /// The step that was attempted last.
  [[nodiscard]] const StepResult& last() const { return last_; }
  /// Where it began; kept if there are switches or `settings.tolerance` asks
  /// for steps that may be taken back.
  [[nodiscard]] const SystemState& before() const { return before_; }
  /// Of all steps so far.
  [[nodiscard]] const StepResult& totals() const { return totals_; }

  /// At about the last step's end, before what happened there.
  [[nodiscard]] const SystemTerms& terms() const { return stepper_.terms(); }

  /// Linear solves since this was asked last, of failed steps, too.
  [[nodiscard]] long take_solves() { return stepper_.take_solves(); }

  /// Drops what it could keep to be faster: what follows depends on the state
  /// and on `exchange_memory` alone.
  void refresh() { stepper_.refresh(); }
  /// What it knows between steps, but for what refresh() drops.
  void exchange_memory(Archive& archive, const SystemState& state);

 private:
  struct Angle {
    std::size_t coupler;
    std::size_t coordinate;
  };
  void advance(SystemState& state, double h, double end);
  void pass(const EventWatch::Crossing& crossing, SystemState& state, double h);
  void pass_all_at_end(SystemState& state, double h);
  void add_last();

  const SystemModel& model_;
  Stepper stepper_;
  EventWatch watch_;
  std::vector<Angle> angles_;
  std::vector<Event>& events_;
  bool is_implicit_ = false;
  bool keeps_before_ = false;
  SystemState before_;
  double h_ = 0.0;  // of the step that was attempted
  int cut_ = 0;     // steps in a row
  StepResult last_;
  StepResult totals_;
};

}  // namespace limber::dynamics
