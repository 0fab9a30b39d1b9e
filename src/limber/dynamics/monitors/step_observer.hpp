// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/monitors/deflection_observer.hpp"
#include "limber/dynamics/monitors/effort_limit_observer.hpp"
#include "limber/dynamics/monitors/energy_observer.hpp"

namespace limber::dynamics {

/// Monitors of every step of a run: energy, joint displacement, drives at their
/// limits.
///
/// Limits     Schemes whose last evaluation is not at the step's end are
///            checked after every eighth step, since it costs another
///            evaluation; their steps resolve all motion.
class StepObserver {
 public:
  /// @param h step of the run, 0 with a tolerance [s]
  /// @param scratch for terms, which others may use between calls
  StepObserver(const SystemModel& model, IntegratorKind integrator, double h,
               SystemTerms& scratch);

  /// @param terms at `state`
  /// @param taken by an impulse just before [J]
  void start(const SystemState& state, const SystemTerms& terms, double taken,
             std::vector<Event>& events);
  /// Accounts for a jump of forces at the end of the last step.
  /// @param flows sums since the start
  void cross_jump(const SystemState& state, const EnergyFlows& flows);
  /// The end of a step. @param terms of the integrator there; null after an
  /// event, which invalidates them @param flows sums since the start
  /// @param is_exact whether it is included whatever the stride, with terms
  /// that are exact
  void include(const SystemState& state, const SystemTerms* terms,
               const EnergyFlows& flows, bool is_exact,
               std::vector<Event>& events);

  /// See EnergyObserver; at the last state included.
  [[nodiscard]] std::optional<EnergyGroups::Excess> find_blow_up(bool is_end) {
    return energy_observer_.find_blow_up(is_end);
  }
  [[nodiscard]] bool has_too_much() { return energy_observer_.has_too_much(); }
  /// See EnergyObserver; at any state.
  [[nodiscard]] bool has_too_much(const SystemState& state) {
    return energy_observer_.has_too_much(state, evaluate(state, Side::right));
  }

  /// See EnergyObserver.
  [[nodiscard]] EnergyObserver::PairStep find_pair_step(
      std::size_t pair) const {
    return energy_observer_.find_pair_step(pair);
  }
  [[nodiscard]] EnergyRecord find_energy() const;
  void add_warnings(std::vector<std::string>& warnings) const;

  /// Saves or restores its state for checkpoints.
  void exchange_memory(Archive& archive);

 private:
  [[nodiscard]] const SystemTerms& evaluate(const SystemState& state,
                                            Side side);
  void record_peak();

  const SystemModel& model_;
  EnergyObserver energy_observer_;
  DeflectionObserver deflection_;
  EffortLimitObserver limits_;
  SystemTerms& terms_;
  long stride_;
  long steps_ = 0;
};

}  // namespace limber::dynamics
