// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/integrators/integrator.hpp"

namespace limber::dynamics {

/// Explicit fourth-order Runge-Kutta on the group (Munthe-Kaas): the classic
/// tableau in the rotation vector of each step. Sums over steps are
/// compensated, so that round-off does not limit the accuracy of short steps.
///
/// Source     Munthe-Kaas, "Runge-Kutta methods on Lie groups", BIT 38, 1998;
///            compensated summation: Knuth's two-sum.
/// Limits     stable only for h below about 2.8 / the highest frequency
///            (dynamics/simulation/explicit_limit.hpp).
class RungeKutta4 final : public Integrator {
 public:
  explicit RungeKutta4(const SystemModel& model);

  StepResult step(SystemState& state, double h, double end) override;
  void exchange_memory(Archive& archive, const SystemState& state) override;
  [[nodiscard]] const SystemTerms& terms() const override { return terms_; }
  [[nodiscard]] const EnergyFlows& flows() const override { return flows_; }

 private:
  struct Slope {
    VectorX motion;  // of rotations since the step's start, and of velocities
    VectorX acceleration;
    VectorX maxwell;
  };
  void calc_slope(const SystemState& at, Side side, Slope& slope);
  void displace(const SystemState& from, const Slope& slope, double h,
                double t);
  void advance(const SystemState& from, const Slope& slope, double h, double t);

  const SystemModel& model_;
  SystemTerms terms_;
  EnergyFlows flows_;
  std::array<Slope, 4> slopes_;
  VectorX moved_;  // since the step's start
  VectorX v_;      // velocities there
  VectorX work_;
  SystemState stage_;
  // The state after the last step, and the round-off of its sums. The carry of
  // a value that the caller has changed since is discarded.
  SystemState left_;
  SystemState carry_;
};

}  // namespace limber::dynamics
