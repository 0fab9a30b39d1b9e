// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/integrators/step_result.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Treatment of motion that steps do not resolve.
enum class UnresolvedMotion {
  kept,       ///< damped as requested of the scheme
  conserved,  ///< not damped, for impacts that steps resolve
  calmed,     ///< halved by each step at least: of stiff contacts at rest
  ended,      ///< as by implicit Euler, for impacts much shorter than a step
};

/// A time integration scheme. It is constructed from a SystemModel and
/// allocates all its memory then; steps allocate nothing. Its IntegratorTraits
/// state its properties.
class Integrator {
 public:
  Integrator() = default;
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;
  virtual ~Integrator() = default;

  /// Advances `state` by h [s], to the time `end` [s], given so that round-off
  /// of t + h does not exceed a load's edge.
  /// @throws NumericalError naming the body or coupler and the time; `state` is
  /// then unchanged.
  virtual StepResult step(SystemState& state, double h, double end) = 0;

  /// Forces and motion at the last evaluation of the last step.
  [[nodiscard]] virtual const SystemTerms& terms() const = 0;

  /// Energy supplied and dissipated over the last step, which sum up to those
  /// of its StepResult.
  [[nodiscard]] virtual const EnergyFlows& flows() const = 0;

  /// Saves or restores its history, which with `state`, the end of the last
  /// step, determines all later steps to the bit.
  virtual void exchange_memory(Archive& archive, const SystemState& state) = 0;

  /// Initialises at `state`, for steps of about h [s]: before the first step,
  /// and after an event that changes velocities.
  virtual void start(const SystemState& /*state*/, double /*h*/) {}
  /// Prepares for the next step, of about h [s], at a discontinuity of a load
  /// at `state`, the end of the last step.
  virtual void cross_jump(const SystemState& /*state*/, double /*h*/) {}
  /// Selects how the next steps damp motion that they do not resolve.
  /// @returns whether they damp all of it; false for schemes without such steps
  virtual bool damp(UnresolvedMotion /*motion*/) { return false; }
  /// Reverts the last step; `before` is the state at its beginning.
  virtual void undo(const SystemState& /*before*/) {}
  /// Discards data of earlier steps that exchange_memory does not save: factors
  /// and predictions.
  virtual void refresh() {}
  /// Number of linear solves since the last call, including failed steps.
  [[nodiscard]] virtual long take_solves() { return 0; }
};

}  // namespace limber::dynamics
