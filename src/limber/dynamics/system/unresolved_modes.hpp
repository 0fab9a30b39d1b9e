// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Numerical damping of the modes that a step of EnergyConserving does not
/// resolve, which the midpoint rule would reverse in every step.
///
/// Equation   with theta = 1 / (1 + rho) and u = (eta_1 - eta_0) / h:
///            u = theta eta'_1 + (1 - theta) eta'_0, and the elastic force is
///            that at theta eta_1 + (1 - theta) eta_0; rho = 1, the midpoint,
///            up to omega h = 2, then 2 / (omega^2 h^2 - 2), by which a very
///            fast mode shrinks in a step. It loses (theta - 1/2) ((eta'_1 -
///            eta'_0) (p_1 - p_0) + omega^2 (eta_1 - eta_0)^2), of momenta p
/// Source     trapezoidal rule with weights
/// Limits     modes whose elasticity is not diagonal keep the midpoint
class UnresolvedModes {
 public:
  /// @param damps else all modes have the midpoint
  UnresolvedModes(const SystemModel& model, bool damps);

  /// For steps of h [s].
  void set_step(const SystemModel& model, double h);

  /// rho of a mode, by its place among all modes [-].
  [[nodiscard]] double ratio(Eigen::Index i) const { return ratios_[i]; }
  /// Their contribution to NewtonMatrix [1/s^2].
  [[nodiscard]] const VectorX& calming() const { return calming_; }
  /// (theta - 1/2) omega^2 h, beside a mode's own damping [1/s].
  [[nodiscard]] double damping(Eigen::Index i) const { return dampings_[i]; }
  /// Power lost in a step of h [s] by one mode's changes of eta' and p, and
  /// mean rate [W].
  [[nodiscard]] double find_loss(Eigen::Index i, double change, double momentum,
                                 double rate, double h) const {
    return excess(i) * change * momentum / h + dampings_[i] * rate * rate;
  }

 private:
  // theta - 1/2
  [[nodiscard]] double excess(Eigen::Index i) const {
    return 0.5 * (1.0 - ratios_[i]) / (1.0 + ratios_[i]);
  }

  bool damps_;
  VectorX ratios_;
  VectorX dampings_;
  VectorX calming_;
};

}  // namespace limber::dynamics
