// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "common/archive.hpp"
#include "dynamics/damper_work.hpp"
#include "dynamics/equations.hpp"
#include "dynamics/exact_correction.hpp"
#include "dynamics/motion_scale.hpp"
#include "dynamics/newton_matrix.hpp"
#include "dynamics/newton_measures.hpp"
#include "dynamics/residual.hpp"
#include "dynamics/step_result.hpp"

namespace limber::dynamics {

/// Lie-group generalized-alpha with Newton's method.
///
/// Equation   inc = h v_n + h^2 ((1/2 - beta) a_n + beta a_n+1),
///            q_n+1 = q_n o exp(inc),
///            v_n+1 = v_n + h ((1 - gamma) a_n + gamma a_n+1),
///            (1 - am) a_n+1 + am a_n = (1 - af) vdot_n+1 + af vdot_n,
///            with the equations of motion met by q, v, vdot at n+1;
///            am = (2 rho - 1) / (rho + 1), af = rho / (rho + 1),
///            gamma = 1/2 + af - am, beta = (1/2 + gamma)^2 / 4.
///            Implicit Euler: inc = h v_n+1, v_n+1 = v_n + h a_n+1, am = af = 0
///            and so beta = gamma = 1 but for the share of a_n in inc.
///            a_n is about vdot(t_n + (am - af) h): where steps change their
///            length, a_n - vdot_n changes with them.
///            Error of a step: (1/6 - beta - (am - af) / 2) h^2 (a_n+1 - a_n).
/// Source     Bruls and Cardona, "On the use of Lie group time integrators in
///            multibody dynamics", J. Comput. Nonlinear Dyn. 5, 2010, eqs.
///            17-22; parameters of Chung and Hulbert, J. Appl. Mech. 60, 1993;
///            the error as Zienkiewicz and Xie, Earthquake Eng. Struct. Dyn.
///            20, 1991, have Newmark's [@zienkiewicz1991].
class GeneralizedAlpha {
 public:
  struct Settings {
    double rho_inf = 0.9;      ///< in [0, 1]
    double tolerance = 1e-12;  ///< of a step's motion [-]
    int max_iterations = 20;
    bool implicit_euler = false;  ///< then rho_inf is not looked at
    bool estimates_error = false;
  };

  GeneralizedAlpha(const SystemModel& model, const Settings& settings);

  /// Finds accelerations to start with from `state`, for steps of about `h`.
  /// Motion that is too stiff for `h` takes its quasi-static share.
  void start(const SystemState& state, double h);

  /// Accounts for loads that jump at state.t (after a step that ended there).
  void cross_jump(const SystemState& state, double h);

  /// Advances `state` by h, to the time `end` (given, so that no round-off of
  /// a sum puts a step's end beyond a load's edge). @throws NumericalError
  /// naming the body, the time and the residual; `state` is then unchanged.
  StepResult step(SystemState& state, double h, double end);

  /// Takes the last step back: the next one is from the state before it, which
  /// the caller has kept.
  void undo();

  /// Drops factors of earlier steps.
  void refresh();
  /// What it knows between steps, of which the last left `state`, but for
  /// those.
  void exchange_memory(Archive& archive, const SystemState& state);

  /// Linear solves since this was asked last, of failed steps, too.
  [[nodiscard]] long take_solves() { return matrix_.take_solves(); }

  /// At the last evaluation of the last step.
  [[nodiscard]] const SystemTerms& terms() const { return terms_; }

 private:
  void set_coefficients(double h);
  void fit_memory(double h);
  void estimate_error(double h, StepResult& result) const;
  void advance(const SystemState& from, double h, double end);
  void apply_increments(double h);
  void add_quasi_static_accelerations();
  bool predict(const SystemState& from, double h, double end);
  void keep_wrenches();
  void restore_wrenches();
  [[nodiscard]] Roundoff measure_wrench_noise();
  void correct(bool exactly);
  double converge(const SystemState& from, double h, double end, bool keeps,
                  bool exactly, StepResult& result);
  void refactor(bool renews_full = false);
  // Decides from a step's slowest contraction whether the next keep factors.
  void plan_factors(bool kept, double slowest);
  [[noreturn]] void fail(const SystemState& from, double h,
                         const CorrectionSize& correction,
                         const char* what) const;

  const SystemModel& model_;
  Settings settings_;
  double am_, af_, gamma_, beta_;
  double lag_;                        // share of h^2 a_n in a step's motion
  std::optional<MotionScale> scale_;  // to estimate errors
  NewtonMatrix matrix_;
  ExactCorrection exact_;
  NewtonMatrix::Coefficients coefficients_;
  double factored_step_ = 0.0;  // h of the factors held, 0: none
  bool renews_full_ = false;    // those of unreduced bodies, too
  int fresh_steps_ = 0;         // how many more steps factor anew
  int next_fresh_steps_ = 0;    // after keeping factors fails again
  double power_load_ = 0.0;     // at the last state, for the audit
  double power_loss_ = 0.0;
  DamperWork damper_work_;
  double last_power_load_ = 0.0;  // at the state before
  double last_power_loss_ = 0.0;

  SystemState next_;
  SystemTerms terms_;
  double memory_step_ = 0.0;  // h that a_ is of, 0: of any
  Rates a_;                   // the algorithm's accelerations at n
  Rates a_next_;
  Rates vdot_;  // accelerations at n
  Rates vdot_next_;
  Rates inc_;  // motion over the step
  VectorX residual_;
  VectorX x_;
  std::vector<Vector6> kept_wrenches_;
  std::vector<Vector6> gaps_;
};

}  // namespace limber::dynamics
