// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/energy_flows.hpp"
#include "limber/dynamics/integrators/damper_work.hpp"
#include "limber/dynamics/integrators/step_result.hpp"
#include "limber/dynamics/integrators/supplied_work.hpp"

namespace limber::dynamics {

/// Work and dissipation of a step: the trapezoidal rule applied to the powers
/// at both ends, with the corrections of DamperWork and SuppliedWork, which
/// integrate along paths, like the mean forces of pairs.
class StepWork {
 public:
  explicit StepWork(const SystemModel& model);

  /// Sets the beginning of the next step. @param terms at `state`
  void start(const SystemState& state, const SystemTerms& terms);
  /// Accounts for a step of `h` [s] from `from` to `to`, where `terms` apply;
  /// the next step begins there. Sets flows(), and the work and powers of
  /// `result`.
  void advance(const SystemState& from, const SystemState& to,
               const SystemTerms& terms, double h, StepResult& result);
  /// Of the last step.
  [[nodiscard]] const EnergyFlows& flows() const { return flows_; }
  /// Reverts the last advance().
  void undo();

  /// Saves or restores the history.
  void exchange_memory(Archive& archive);

 private:
  void set_powers(const SystemTerms& terms);
  void add_slip(const SystemTerms& terms, double duration,
                EnergyFlows& flows) const;

  Eigen::Index pairs_;  // first of their rows
  DamperWork dampers_;
  SuppliedWork supplies_;
  EnergyFlows power_;       // at the last state [W]
  EnergyFlows last_power_;  // at the one before [W]
  EnergyFlows flows_;
};

}  // namespace limber::dynamics
