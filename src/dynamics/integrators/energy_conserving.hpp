// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "dynamics/newton_matrix.hpp"
#include "dynamics/step_forces.hpp"
#include "dynamics/step_result.hpp"

namespace limber::dynamics {

/// Implicit scheme whose energy balances exactly, step by step: kinetic,
/// elastic and couplers' energy change by the work of loads less what is
/// dissipated, for any step. A free system keeps its momenta, too.
///
/// Equation   with x = (x_0 + x_1) / 2 of velocities and of eta, and momenta
///            pi = J(eta) w + H(eta) eta', p = eta' + H(eta)' w at both ends:
///            p_WB1 = p_WB0 + h v,  R_1 = R_0 cay(h w),  eta_1 = eta_0 + h
///            eta', mass (v_1 - v_0) = h f, pi_1 - pi_0 = h ((pi_0 + pi_1) / 2
///            x w + t), p_k1 - p_k0 = h (f_k - lambda_k eta_k - c_k eta'_k +
///            g_k), g_k = w_0 . dJ/deta_k(eta) w_1 / 2
///                  + (w_0 . beta_k eta'_1 + w_1 . beta_k eta'_0) / 2;
///            forces as StepMotion has them, of laws over a step.
///            J is of second degree in eta and H of first, so that w . (pi_1 -
///            pi_0) + eta' . (p_1 - p_0) - g . (eta_1 - eta_0) is the change
///            of kinetic energy, without remainder.
/// Source     energy and momentum conserving schemes: [@simo1991] of rigid
///            bodies, [@gonzalez1996]; the inertial coupling is our own
/// Limits     second order. Nothing is damped, so that motion which the step
///            does not resolve goes on, with its energy and the wrong
///            frequency. A joint turns less than half a turn a step. Of level
///            one-way, whose equations keep no energy, it keeps none.
///            Not for level `full`.
class EnergyConserving {
 public:
  struct Settings {
    /// Newton's method goes on to round-off; this is what has to be reached
    /// within max_iterations, of a step's motion [-].
    double tolerance = 1e-12;
    int max_iterations = 20;
  };

  EnergyConserving(const SystemModel& model, const Settings& settings);

  /// Advances `state` by h, to the time `end`. @throws NumericalError naming
  /// the body or the coupler and the time; `state` is then unchanged.
  StepResult step(SystemState& state, double h, double end);

  /// Drops factors and the guess of what acts. It knows nothing else between
  /// steps.
  void refresh() {
    factored_step_ = 0.0;
    has_wrenches_ = false;
  }

  /// Linear solves since this was asked last, of failed steps, too.
  [[nodiscard]] long take_solves() { return matrix_.take_solves(); }

  /// At about the last step's end.
  [[nodiscard]] const SystemTerms& terms() const { return end_; }

 private:
  struct Size {
    double value = 0.0;
    std::size_t body = 0;
  };
  void predict(const SystemState& from, double h);
  void advance(const SystemState& from, double h, double end);
  void calc_residual(const SystemState& from, double h);
  void calc_body_residual(const SystemState& from, double h, std::size_t b);
  void factor();
  [[nodiscard]] Vector3 change_turn(std::size_t b, const Vector3& x) const;
  void apply_increments(double h);
  [[nodiscard]] Size measure_increments() const;
  [[nodiscard]] double measure_motion(double h) const;
  [[nodiscard]] double measure_roundoff() const;

  const SystemModel& model_;
  Settings settings_;
  NewtonMatrix matrix_;
  NewtonMatrix::Coefficients coefficients_;
  double factored_step_ = 0.0;  // h of the factors held, 0: none

  SystemTerms begin_;
  SystemTerms end_;
  // What acts over the step. The wrenches applied in the last one are the first
  // guess of the next; a scheme that has none takes those of the laws.
  SystemTerms mean_;
  bool has_wrenches_ = false;
  StepMotion motion_;
  SystemState middle_;  // velocities and eta; positions are not looked at
  SystemState next_;
  std::vector<Vector3> turns_;  // of bodies over the step
  VectorX residual_;
  VectorX x_;
};

}  // namespace limber::dynamics
