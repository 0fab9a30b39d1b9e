// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/integrators/integrator.hpp"
#include "limber/dynamics/integrators/maxwell_motion.hpp"

namespace limber::dynamics {

/// Central differences (velocity Verlet), rotation on the group.
///
/// Equation   q+ = q o exp(h v + h^2/2 a),  a+ = a(q+, v + h a),
///            v+ = v + h/2 (a + a+)
/// Source     [@belytschko2000, sec. 6.2]; second order, one evaluation of the
///            forces a step. Without velocity-dependent forces, as for the
///            nodes of an unreduced body, symplectic: it keeps momenta to
///            round-off.
/// Limits     stable below find_stable_step
/// (dynamics/integrators/stable_step.hpp)
class CentralDifferences final : public Integrator {
 public:
  explicit CentralDifferences(const SystemModel& model);

  /// Evaluates the accelerations at `state`.
  void start(const SystemState& state, double h) override;
  void cross_jump(const SystemState& state, double h) override {
    start(state, h);
  }
  void undo(const SystemState& before) override { start(before, 0.0); }
  /// @throws NumericalError also where an element is inverted.
  StepResult step(SystemState& state, double h, double end) override;
  void exchange_memory(Archive& archive, const SystemState& state) override;
  [[nodiscard]] const SystemTerms& terms() const override { return terms_; }
  [[nodiscard]] const EnergyFlows& flows() const override { return flows_; }

 private:
  void displace(const SystemState& from, double h, double end);

  const SystemModel& model_;
  SystemTerms terms_;
  VectorX v_;  // velocities at n
  VectorX a_;  // accelerations at n
  VectorX a_next_;
  VectorX work_;
  EnergyFlows power_;  // at the end of the last step [W]
  EnergyFlows flows_;
  SystemState next_;
  MaxwellMotion maxwell_;
};

}  // namespace limber::dynamics
