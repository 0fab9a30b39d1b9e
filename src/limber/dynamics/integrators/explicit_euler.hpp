// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/integrators/free_vibration.hpp"
#include "limber/dynamics/integrators/integrator.hpp"

namespace limber::dynamics {

/// The WOBBLE package's scheme: rigid motion by the accelerations at the step's
/// start, modes by their exact response to the load at the step's start.
///
/// Equation   p += h v + h^2 a / 2, v += h a,
///            R <- R exp(h w + h^2 dw / 2), w += h dw,
///            each mode under f(t_n) exactly (FreeVibration)
/// Source     WOBBLE report (EPFL LSMS, 2023), Eqs. 12, 26-28
/// Limits     first order; energy grows with rotation. For comparison and for
///            cheap runs; not for stiff couplers.
class ExplicitEuler final : public Integrator {
 public:
  explicit ExplicitEuler(const SystemModel& model);

  StepResult step(SystemState& state, double h, double end) override;
  /// Does nothing: the scheme has no history.
  void exchange_memory(Archive& /*archive*/,
                       const SystemState& /*state*/) override {}

  [[nodiscard]] const SystemTerms& terms() const override { return terms_; }
  [[nodiscard]] const EnergyFlows& flows() const override { return flows_; }

 private:
  const SystemModel& model_;
  SystemTerms terms_;
  VectorX accelerations_;  // of modes: the loads on them
  SystemState next_;
  EnergyFlows flows_;
  FreeVibration modes_;  // over a step
};

}  // namespace limber::dynamics
