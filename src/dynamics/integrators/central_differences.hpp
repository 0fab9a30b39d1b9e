// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/archive.hpp"
#include "dynamics/equations.hpp"
#include "dynamics/step_result.hpp"

namespace limber::dynamics {

/// Central differences (velocity Verlet), rotation on the group.
///
/// Equation   q+ = q o exp(h v + h^2/2 a),  a+ = a(q+, v + h a),
///            v+ = v + h/2 (a + a+)
/// Source     [@belytschko2000, sec. 6.2]; second order, one evaluation of the
///            forces a step. Without velocity-dependent forces, as for the
///            nodes of an unreduced body, symplectic: it keeps momenta to
///            round-off.
/// Limits     stable below find_stable_step (dynamics/stable_step.hpp)
class CentralDifferences {
 public:
  explicit CentralDifferences(const SystemModel& model);

  /// Takes the accelerations from `state`: before the first step, and after a
  /// jump of the loads.
  void start(const SystemState& state);

  /// Advances `state` by h, to the time `end` (given, so that no round-off of
  /// a sum puts a step's end beyond a load's edge). @throws NumericalError if
  /// the motion is no longer finite or an element is inside out; `state` is
  /// then unchanged.
  StepResult step(SystemState& state, double h, double end);

  /// What it knows between steps, of which the last left `state`.
  void exchange_memory(Archive& archive, const SystemState& state);

  /// At the last evaluation of the last step.
  [[nodiscard]] const SystemTerms& terms() const { return terms_; }

 private:
  void displace(const SystemState& from, double h, double end);

  const SystemModel& model_;
  SystemTerms terms_;
  Accelerations a_;
  Accelerations a_next_;
  double power_load_ = 0.0;
  double power_loss_ = 0.0;
  SystemState next_;
};

}  // namespace limber::dynamics
