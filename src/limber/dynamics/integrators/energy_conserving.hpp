// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/dynamics/integrators/integrator.hpp"
#include "limber/dynamics/integrators/maxwell_motion.hpp"
#include "limber/dynamics/integrators/step_forces.hpp"
#include "limber/dynamics/newton/convergence.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/system/unresolved_modes.hpp"

namespace limber::dynamics {

/// Implicit scheme whose energy balances exactly, step by step: kinetic,
/// elastic and couplers' energy change by the work of loads less dissipation,
/// for any step. A free system also keeps its momenta.
///
/// Equation   with x = (x_0 + x_1) / 2 of velocities and of eta, and momenta
///            pi = J(eta) w + H(eta) eta', p = eta' + H(eta)' w at both ends:
///            p_WB1 = p_WB0 + h v,  R_1 = R_0 cay(h w),  eta_1 = eta_0 + h
///            eta', mass (v_1 - v_0) = h f, pi_1 - pi_0 = h ((pi_0 + pi_1) / 2
///            x w + t), p_k1 - p_k0 = h (f_k - e_k - c_k eta'_k +
///            g_k), e_k = lambda_k eta_k, or the discrete gradient of another
///            elasticity (flexbody/elasticity), g_k = w_0 . dJ/deta_k(eta) w_1
///            / 2
///                  + (w_0 . beta_k eta'_1 + w_1 . beta_k eta'_0) / 2;
///            forces as in step_motion.hpp, from the laws over a step.
///            J is of second degree in eta and H of first, so that w . (pi_1 -
///            pi_0) + eta' . (p_1 - p_0) - g . (eta_1 - eta_0) is the change
///            of kinetic energy, without remainder.
/// Source     energy and momentum conserving schemes: [@simo1991] for rigid
///            bodies, [@gonzalez1996]; the inertial coupling is Limber's own
/// Limits     second order. Without numerical damping, unless
///            Settings::damps_unresolved: motion that the step does not
///            resolve persists, with its energy and the wrong frequency. A
///            joint must turn less than half a turn a step. Energy
///            is not conserved at level one-way, whose equations do not
///            conserve it. Not for level `full`.
class EnergyConserving final : public Integrator {
 public:
  struct Settings {
    /// Newton's method iterates to round-off. Corrections below this that
    /// shrink less than the one before are round-off; it fails if the
    /// correction is still larger after max_iterations. Relative to the step's
    /// motion [-].
    double tolerance = 1e-12;
    int max_iterations = 20;  ///< count, per step
    /// Whether UnresolvedModes damps; that counts as dissipated.
    bool damps_unresolved = false;
  };

  EnergyConserving(const SystemModel& model, const Settings& settings);

  StepResult step(SystemState& state, double h, double end) override;
  /// Does nothing: the last steps only predict the next.
  void exchange_memory(Archive& /*archive*/,
                       const SystemState& /*state*/) override {}
  /// Discards factors and the last steps, which predict the next.
  void refresh() override {
    factored_step_ = 0.0;
    courses_[0].h = courses_[1].h = 0.0;
  }
  [[nodiscard]] long take_solves() override { return matrix_.take_solves(); }
  [[nodiscard]] const SystemTerms& terms() const override { return end_; }
  [[nodiscard]] const EnergyFlows& flows() const override { return flows_; }

 private:
  void predict(const SystemState& from, double h);
  void predict_anew(const SystemState& from, double h);
  [[nodiscard]] bool continues(const SystemState& from) const;
  void keep_course(const SystemState& end, double h);
  void advance(const SystemState& from, double h, double end);
  void calc_residual(const SystemState& from, double h);
  void calc_body_residual(const SystemState& from, double h, std::size_t b);
  void factor(const SystemState& from);
  void add_losses(const SystemState& from, double h);
  void turn_increments();
  void apply_increments(double h, double fraction);
  void set_motion(double h);
  [[nodiscard]] double find_noise(const GroupProgress& group) const;
  void judge();
  [[nodiscard]] bool is_noise() const;
  [[nodiscard]] bool contracts_poorly(double poor) const;
  [[noreturn]] void fail(double end, const char* what);

  const SystemModel& model_;
  Settings settings_;
  NewtonMatrix matrix_;
  NewtonMatrix::Coefficients coefficients_;
  double factored_step_ = 0.0;  // h of the factors held, 0: none

  SystemTerms begin_;
  SystemTerms end_;
  // Forces over the step. The wrenches of the last step are the initial guess
  // of the next.
  SystemTerms mean_;
  StepMotion motion_;
  EnergyFlows flows_;
  MaxwellMotion maxwell_;
  VectorX elastic_;     // of modes that elasticity couples: at the begin, e_k
  SystemState middle_;  // velocities and eta; its positions are not used
  SystemState next_;
  VectorX rotations_;  // rows of rotations: Cayley's vectors of the step
  UnresolvedModes unresolved_;
  VectorX change_;  // of the momenta of modes over the step
  VectorX residual_;
  VectorX x_;
  VectorX step_;  // motion over the step
  // The last two steps, the last one first; they predict the next.
  struct Course {
    VectorX mean;    // velocities
    double h = 0.0;  // 0: there is none [s]
  };
  std::array<Course, 2> courses_;
  SystemState left_;  // where the last one ended
  NewtonProgress progress_;
};

}  // namespace limber::dynamics
