// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/equations/motion_scale.hpp"
#include "limber/dynamics/integrators/alpha_parameters.hpp"
#include "limber/dynamics/integrators/integrator.hpp"
#include "limber/dynamics/integrators/maxwell_motion.hpp"
#include "limber/dynamics/integrators/step_work.hpp"
#include "limber/dynamics/newton/convergence.hpp"
#include "limber/dynamics/newton/exact_correction.hpp"
#include "limber/dynamics/newton/factor_plan.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/dynamics/newton/newton_measures.hpp"

namespace limber::dynamics {

/// Lie-group generalized-alpha with Newton's method.
///
/// Equation   inc = h v_n + h^2 ((1/2 - beta) a_n + beta a_n+1),
///            q_n+1 = q_n o exp(inc),
///            v_n+1 = v_n + h ((1 - gamma) a_n + gamma a_n+1),
///            (1 - am) a_n+1 + am a_n = (1 - af) vdot_n+1 + af vdot_n,
///            with the equations of motion satisfied by q, v, vdot at n+1;
///            am = (2 rho - 1) / (rho + 1), af = rho / (rho + 1),
///            gamma = 1/2 + af - am, beta = (1/2 + gamma)^2 / 4.
///            Implicit Euler: inc = h v_n+1, v_n+1 = v_n + h a_n+1, am = af =
///            0; hence beta = gamma = 1, and a_n does not enter inc. a_n
///            approximates vdot(t_n + (am - af) h): where the step changes, a_n
///            - vdot_n is scaled with it. Error of a step: (1/6 - beta - (am -
///            af) / 2) h^2 (a_n+1 - a_n).
/// Source     Bruls and Cardona, "On the use of Lie group time integrators in
///            multibody dynamics", J. Comput. Nonlinear Dyn. 5, 2010, eqs.
///            17-22; parameters: Chung and Hulbert, J. Appl. Mech. 60, 1993;
///            error: as that of Newmark's method by Zienkiewicz and Xie,
///            Earthquake Eng. Struct. Dyn. 20, 1991 [@zienkiewicz1991].
class GeneralizedAlpha final : public Integrator {
 public:
  struct Settings {
    double rho_inf = 0.9;  ///< spectral radius at infinity, in [0, 1] [-]
    /// Largest error of Newton's method relative to the step's motion [-]. 0: a
    /// hundredth of the step's error; for rho_inf = 1, which does not damp,
    /// 1e-12.
    double tolerance = 0.0;
    int max_iterations = 20;      ///< count, per step
    bool implicit_euler = false;  ///< rho_inf is then ignored
    bool estimates_error = false;
  };

  GeneralizedAlpha(const SystemModel& model, const Settings& settings);

  /// Finds initial accelerations; quasi-static ones for motion that is too
  /// stiff for `h` [s].
  void start(const SystemState& state, double h) override;
  void cross_jump(const SystemState& state, double h) override;
  StepResult step(SystemState& state, double h, double end) override;
  void undo(const SystemState& before) override;
  void refresh() override;
  bool damp(UnresolvedMotion motion) override;
  void exchange_memory(Archive& archive, const SystemState& state) override;
  [[nodiscard]] long take_solves() override { return matrix_.take_solves(); }
  [[nodiscard]] const SystemTerms& terms() const override { return terms_; }
  [[nodiscard]] const EnergyFlows& flows() const override {
    return work_.flows();
  }

 private:
  enum class Corrections { by_factors, exact, exact_halved };

  void set_coefficients(double h);
  void fit_memory(double h);
  void estimate_error(double h, StepResult& result) const;
  void set_limits(bool has_trend);
  void judge_early(bool keeps);
  void advance(const SystemState& from, double h, double end);
  void apply_increments(double h, double taken);
  void factor_afresh();
  void add_quasi_static_accelerations();
  bool predict(const SystemState& from, double h, double end);
  void extrapolate_wrenches(double h);
  void restore_wrenches();
  void add_wrench_noise();
  void correct(bool exactly);
  void converge_somehow(const SystemState& from, double h, double end,
                        bool keeps, StepResult& result);
  void converge(const SystemState& from, double h, double end, bool keeps,
                Corrections corrections, StepResult& result);
  void refactor(bool renews_all = false);
  void renew_factors(double h, double end, StepResult& result);
  [[noreturn]] void fail(const SystemState& from, double h,
                         const char* what) const;

  const SystemModel& model_;
  Settings settings_;
  AlphaParameters p_;
  UnresolvedMotion unresolved_ = UnresolvedMotion::kept;
  std::optional<MotionScale> scale_;  // to estimate errors
  NewtonMatrix matrix_;
  ExactCorrection exact_;
  NewtonMatrix::Coefficients coefficients_;
  double factored_step_ = 0.0;  // h of the current factors, 0: none [s]
  bool renews_all_ = false;     // also factors of unreduced bodies
  double trend_step_ = 0.0;  // vdot_next_ is from this long before, 0: not [s]
  StepWork work_;
  MaxwellMotion maxwell_;

  SystemState next_;
  SystemTerms terms_;
  double memory_step_ = 0.0;  // h for which a_ holds, 0: for any [s]
  // Of all unknowns.
  VectorX a_;       // the algorithm's accelerations at n
  VectorX a_next_;  // at n + 1
  VectorX vdot_;    // accelerations at n
  VectorX vdot_next_;
  VectorX v_;  // velocities at n
  VectorX v_next_;
  VectorX motion_;  // over the step
  VectorX residual_;
  VectorX x_;
  NewtonProgress progress_;
  FactorPlan plan_;
  FactorPlan::Course course_;  // of the last step
  VectorX kept_wrenches_;      // of the last state
  VectorX last_wrenches_;      // of the state before, if trend_step_ > 0
  std::vector<Vector6> gaps_;
};

}  // namespace limber::dynamics
