// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/energy_ledger.hpp"
#include "dynamics/hold_watch.hpp"
#include "dynamics/limit_watch.hpp"
#include "dynamics/simulation.hpp"

namespace limber::dynamics {

/// What is watched at every step of a run: its energy, joints that give way,
/// drives at their limits.
///
/// Limits     Schemes whose last evaluation is not that of a step's end are
///            looked at after every eighth step, since it costs one more; they
///            resolve all motion.
class StepAudit {
 public:
  StepAudit(const SystemModel& model, IntegratorKind integrator);

  /// @param terms at `state` @param totals of what happened before it
  void start(const SystemState& state, const SystemTerms& terms,
             const StepResult& totals, std::vector<Event>& events);
  /// Forces jump at the end of the last step. @param terms of the integrator
  void cross_jump(const SystemState& state, const SystemTerms& terms);
  /// The end of a step. @param terms of the integrator there; null where
  /// something happened, after which they no longer hold
  void include(const SystemState& state, const SystemTerms* terms,
               const StepResult& totals, bool is_last,
               std::vector<Event>& events);

  [[nodiscard]] EnergyRecord find_energy() const {
    return ledger_.find_record();
  }
  [[nodiscard]] std::vector<std::string> find_warnings() const;

  /// What it knows between steps.
  void exchange_memory(Archive& archive);

 private:
  [[nodiscard]] const SystemTerms& evaluate(const SystemState& state);

  const SystemModel& model_;
  EnergyLedger ledger_;
  HoldWatch holds_;
  LimitWatch limits_;
  SystemTerms terms_;
  long stride_;
  long steps_ = 0;
};

}  // namespace limber::dynamics
