// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/integrators/free_vibration.hpp"
#include "limber/dynamics/integrators/integrator.hpp"

namespace limber::dynamics {

/// Explicit splitting scheme: exact vibration of modes, impulses of all other
/// forces.
///
/// Equation   drift(h/2), kick(h), drift(h/2). Drift: p += h v / 2,
///            R <- R exp(h w / 2), each mode free, with its dampers and Maxwell
///            elements, exactly (FreeVibration). Kick: velocities change by all
///            other forces at fixed positions and time, by the midpoint rule: a
///            change over h/2 with the velocities before, then over h with
///            those midway.
/// Source     [@strang1968]; with oscillators and impulses:
///            [@garciaarchilla1998]
/// Limits     second order. Modes do not limit the step; the stiffness and
///            damping of couplers do (h below about 2 / their highest frequency
///            on the bodies), and rotation (well below a radian a step). Steps
///            near a multiple of half a mode's period resonate with its kicks:
///            its amplitude may grow. Energy of fast rotation grows by
///            (w h)^4 / 8 a step. Not for level `full`.
class Splitting final : public Integrator {
 public:
  explicit Splitting(const SystemModel& model);

  StepResult step(SystemState& state, double h, double end) override;
  /// Does nothing: the scheme has no history.
  void exchange_memory(Archive& /*archive*/,
                       const SystemState& /*state*/) override {}

  /// Terms at the middle of the last step; motion of couplers at its end.
  [[nodiscard]] const SystemTerms& terms() const override { return terms_; }
  [[nodiscard]] const EnergyFlows& flows() const override { return flows_; }

 private:
  void drift(SystemState& state);
  void calc_kick();
  void kick(const SystemState& from, double h, SystemState& to) const;

  const SystemModel& model_;
  SystemTerms terms_;
  VectorX kick_;  // without the modes' own springs and dampers
  SystemState next_;
  SystemState middle_;
  EnergyFlows flows_;
  FreeVibration modes_;  // over half a step
};

}  // namespace limber::dynamics
