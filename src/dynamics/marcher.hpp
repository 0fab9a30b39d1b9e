// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/event_watch.hpp"
#include "dynamics/stepper.hpp"

namespace limber::dynamics {

/// Takes steps, in parts where something happens at a coupler within one, and
/// keeps what couplers remember. Without switches and angles it adds nothing to
/// a step.
///
/// Equation   what a switch does to a law is held through a step, so that the
///            motion is smooth within one, and changes where the step is cut.
/// Source     events by the cubic through the values and rates at both ends of
///            a step [@hairer1993, sec. II.6], whose error is smaller than that
///            of the integrators.
/// Limits     a joint turns less than half a turn a step; of two changes of
///            sign of one switch within a step neither is seen.
class Marcher {
 public:
  /// @param events what happens is added here
  Marcher(const SystemModel& model, const SimulationSettings& settings,
          std::vector<Event>& events);

  /// Before the first step, which will be about `h` long [s]. Latches within
  /// reach close.
  void start(SystemState& state, double h);
  /// After a step that ended where a load jumps.
  void cross_jump(const SystemState& state, double h);
  /// Advances `state` by h, to the time `end` [s].
  /// @throws NumericalError naming the body or coupler and the time.
  void step(SystemState& state, double h, double end);

  /// Of all steps so far.
  [[nodiscard]] const StepResult& totals() const { return totals_; }

 private:
  struct Angle {
    std::size_t coupler;
    std::size_t coordinate;
  };
  void advance(SystemState& state, double h, double end, StepResult& result);
  void go_back(SystemState& state);
  void pass(const EventWatch::Crossing& crossing, SystemState& state, double h);
  void pass_all_at_end(SystemState& state, double h);
  void add(const StepResult& result);

  const SystemModel& model_;
  Stepper stepper_;
  EventWatch watch_;
  std::vector<Angle> angles_;
  std::vector<Event>& events_;
  SystemState before_;
  StepResult totals_;
};

}  // namespace limber::dynamics
