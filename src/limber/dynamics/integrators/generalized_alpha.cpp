// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/generalized_alpha.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/nodal_rotation.hpp"
#include "limber/dynamics/equations/motion_fields.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/newton/applied_wrenches.hpp"
#include "limber/dynamics/newton/convergence.hpp"
#include "limber/dynamics/newton/newton_failure.hpp"
#include "limber/dynamics/newton/velocity_terms.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Largest growth of a step over which accelerations are extrapolated [-].
constexpr double kMostStretch = 2.0;
// Contraction above which factors are renewed within a step [-].
constexpr double kPoorContraction = 0.3;
// Forces evaluated within this fraction of a step's motion from its end count
// as those of the end [-].
constexpr double kSamePlace = 1e-9;
// Number of slow corrections with fresh factors after which the exact
// derivative is used.
constexpr int kSlowCorrections = 2;
// Number of successive growing exact corrections that counts as divergence.
constexpr int kMostGrowing = 4;

}  // namespace

GeneralizedAlpha::GeneralizedAlpha(const SystemModel& model,
                                   const Settings& settings)
    : model_(model),
      settings_(settings),
      p_(settings.implicit_euler ? AlphaParameters{}
                                 : find_alpha_parameters(settings.rho_inf)),
      matrix_(model),
      exact_(model),
      work_(model),
      maxwell_(model, flexbody::set_linear_step),
      next_(make_state(model)),
      terms_(make_terms(model)),
      a_(make_unknowns(model)),
      a_next_(a_),
      vdot_(a_),
      vdot_next_(a_),
      v_(a_),
      v_next_(a_),
      motion_(a_),
      residual_(a_),
      x_(a_),
      progress_(model),
      plan_(progress_.groups().size()),
      course_(progress_.groups().size()),
      kept_wrenches_(VectorX::Zero(count_wrench_rows(terms_))),
      last_wrenches_(kept_wrenches_),
      gaps_(model.couplers.size() + model.transmissions.size(),
            Vector6::Zero()) {
  if (settings.estimates_error) scale_.emplace(model);
  const bool conserves = !settings.implicit_euler && settings.rho_inf == 1.0;
  if (conserves && settings.tolerance == 0.0)
    settings_.tolerance = kLeastFraction;
}

bool GeneralizedAlpha::damp(UnresolvedMotion motion) {
  if (!settings_.implicit_euler && motion != unresolved_) {
    unresolved_ = motion;
    p_ = find_alpha_parameters(settings_.rho_inf, motion);
    refresh();
  }
  return !settings_.implicit_euler && unresolved_ == UnresolvedMotion::ended;
}

void GeneralizedAlpha::refresh() {
  factored_step_ = 0.0;
  renews_all_ = true;
  trend_step_ = 0.0;
  plan_.refresh();
}

void GeneralizedAlpha::exchange_memory(Archive& archive,
                                       const SystemState& state) {
  archive(a_, vdot_, memory_step_);
  plan_.exchange_memory(archive);
  work_.exchange_memory(archive);
  for (CouplerTerms& coupler : terms_.couplers) archive(coupler.applied);
  for (TransmissionTerms& t : terms_.transmissions) archive(t.applied);
  if (archive.reads()) next_ = state;
}

// Scales a_n - vdot_n to steps of `h` [s].
void GeneralizedAlpha::fit_memory(double h) {
  constexpr double kSame = 1e-9;
  // A larger factor would amplify round-off more than it corrects.
  constexpr double kMostGrowth = 4.0;
  const double ratio = memory_step_ > 0.0 ? h / memory_step_ : 1.0;
  memory_step_ = h;
  if (std::abs(ratio - 1.0) <= kSame) return;
  const double fraction = ratio <= kMostGrowth ? ratio : 0.0;
  a_ = vdot_ + fraction * (a_ - vdot_);
}

void GeneralizedAlpha::estimate_error(double h, StepResult& result) const {
  const double constant = 1.0 / 6.0 - p_.beta - 0.5 * (p_.am - p_.af);
  const MotionScale::Largest largest =
      scale_->measure_change(a_, a_next_, constant * h * h, p_.beta * h * h);
  result.error = largest.displacement;
  result.error_body = largest.body;
}

// Largest errors of Newton's method, by convergence.hpp or by the settings.
void GeneralizedAlpha::set_limits(bool has_trend) {
  std::vector<GroupProgress>& groups = progress_.groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double limit = settings_.tolerance * groups[g].motion;
    groups[g].limit =
        settings_.tolerance > 0.0
            ? CorrectionSize{.value = limit, .rigid = limit, .modal = limit}
            : find_limit(
                  has_trend ? course_.corrections[0][g] : CorrectionSize{},
                  p_.gamma, groups[g].motion);
  }
}

void GeneralizedAlpha::set_coefficients(double h) {
  coefficients_.acceleration =
      (1.0 - p_.am) / ((1.0 - p_.af) * p_.beta * h * h);
  coefficients_.velocity = p_.gamma / (p_.beta * h);
  maxwell_.set_step(h, terms_);
}

void GeneralizedAlpha::refactor(bool renews_all) {
  matrix_.factor(model_, next_, terms_, motion_, coefficients_,
                 renews_all || renews_all_);
  renews_all_ = false;
}

// Factors for a start at the current state, which no step keeps, and no gaps.
void GeneralizedAlpha::factor_afresh() {
  motion_.setZero();
  std::ranges::fill(gaps_, Vector6::Zero());
  refactor();
  factored_step_ = 0.0;
}

// Factors for the current iterate. Unreduced bodies keep their stiffness and
// renew only its frame, unless `renews_all`.
void GeneralizedAlpha::renew_factors(double h, double end, StepResult& result) {
  try {
    refactor(result.factorizations > 0);
  } catch (const NumericalError& error) {
    throw NumericalError(fmt::format("{} (a step of {:.3g} s to t = {:.9g} s)",
                                     error.what(), h, end));
  }
  ++result.factorizations;
  factored_step_ = h;
}

// Adds accelerations for the residual and the gaps of links: M^-1 times it for
// motion that the step resolves, quasi-static ones for stiffer motion.
void GeneralizedAlpha::add_quasi_static_accelerations() {
  matrix_.solve(model_, terms_, residual_, gaps_, x_);
  a_ += coefficients_.acceleration * x_;
  vdot_ += coefficients_.acceleration * x_;
}

void GeneralizedAlpha::start(const SystemState& state, double h) {
  memory_step_ = trend_step_ = 0.0;
  next_ = state;
  set_coefficients(h);
  a_.setZero();
  vdot_ = vdot_next_ = a_;
  calc_terms(model_, next_, Side::right, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  factor_afresh();
  add_velocity_terms(terms_, find_velocity_terms(model_, next_),
                     coefficients_.acceleration, coefficients_.velocity, gaps_);
  add_quasi_static_accelerations();
  work_.start(next_, terms_);
}

void GeneralizedAlpha::cross_jump(const SystemState& state, double h) {
  next_ = state;
  set_coefficients(h);
  vdot_next_ = vdot_;
  trend_step_ = 0.0;
  calc_terms(model_, next_, Side::left, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  const VectorX before = residual_;
  calc_forces(model_, next_, Side::right, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  residual_ -= before;
  factor_afresh();
  add_quasi_static_accelerations();
  work_.start(next_, terms_);
}

// The step's end that a_next_ implies.
void GeneralizedAlpha::advance(const SystemState& from, double h, double end) {
  const double inc_n = h * h * p_.lag;
  const double inc_next = h * h * p_.beta;
  const double v_n = h * (1.0 - p_.gamma);
  const double v_next = h * p_.gamma;
  const double d_next = (1.0 - p_.am) / (1.0 - p_.af);
  const double d_n = p_.am / (1.0 - p_.af);
  const double d_old = p_.af / (1.0 - p_.af);
  motion_ = h * v_ + inc_n * a_ + inc_next * a_next_;
  v_next_ = v_ + v_n * a_ + v_next * a_next_;
  vdot_next_ = d_next * a_next_ + d_n * a_ - d_old * vdot_;
  next_.bodies = from.bodies;
  next_.eta = from.eta;
  next_.u_H = from.u_H;
  displace(model_, motion_, 1.0, next_);
  set_velocities(model_, v_next_, next_);
  maxwell_.advance(from, next_);
  next_.t = end;
}

void GeneralizedAlpha::apply_increments(double h, double taken) {
  x_ *= taken;
  add_to_applied(matrix_.wrench_increments(), terms_, taken);
  rotate_corrections(model_, next_, x_);
  for (const BodyModel& body : model_.bodies) {
    const Vector3 rotation = rotation_rows(body, motion_);
    const Vector3 x = rotation_rows(body, x_);
    rotation_rows(body, x_) = right_jacobian_inverse(rotation) * x;
  }
  a_next_ += 1.0 / (p_.beta * h * h) * x_;
}

void GeneralizedAlpha::fail(const SystemState& from, double h,
                            const char* what) const {
  const GroupProgress& worst = progress_.find_worst();
  throw NumericalError(describe(
      {model_, from, terms_, x_, worst.now, h, next_.t, worst.limit.value},
      what));
}

// Predicts the step's end by accelerations that change as over the last step;
// for rotating unreduced bodies by those of rigid motion. @returns whether such
// a body rotates.
bool GeneralizedAlpha::predict(const SystemState& from, double h, double end) {
  const double ratio = trend_step_ > 0.0 ? h / trend_step_ : 0.0;
  const double trend = ratio <= kMostStretch ? ratio : 0.0;
  trend_step_ = 0.0;
  const double p_last = trend * (1.0 - p_.af) / (1.0 - p_.am);
  const double p_v = 1.0 / (1.0 - p_.am) + p_last;
  const double p_a = p_.am / (1.0 - p_.am);
  a_next_ = p_v * vdot_ - p_a * a_ - p_last * vdot_next_;
  nodal_rows(model_, a_next_) =
      (nodal_rows(model_, vdot_) - p_.am * nodal_rows(model_, a_)) /
      (1.0 - p_.am);
  const bool rotates =
      predict_rotations(model_, from, vdot_, a_, {h, p_.lag, p_.beta}, a_next_);
  get_velocities(model_, from, v_);
  copy_step_constants(from, next_);
  advance(from, h, end);
  return rotates;
}

// Wrenches change as over the last step, as the predicted accelerations do:
// after an event they start from those of the last state.
void GeneralizedAlpha::extrapolate_wrenches(double h) {
  get_applied(terms_, kept_wrenches_);
  const double ratio = trend_step_ > 0.0 ? h / trend_step_ : 0.0;
  if (ratio > 0.0 && ratio <= kMostStretch) {
    last_wrenches_ = kept_wrenches_ + ratio * (kept_wrenches_ - last_wrenches_);
    set_applied(last_wrenches_, terms_);
  }
  last_wrenches_ = kept_wrenches_;
}

// Restores the wrenches at the last state as the initial guess.
void GeneralizedAlpha::restore_wrenches() {
  set_applied(kept_wrenches_, terms_);
  factored_step_ = 0.0;
}

// Adds the effect on the motion of round-off in stiff wrenches, by the current
// factors.
void GeneralizedAlpha::add_wrench_noise() {
  find_roundoff_gaps(model_, terms_, coefficients_.velocity, gaps_);
  calc_pair_roundoff(model_, next_, terms_, coefficients_.velocity, residual_);
  matrix_.solve(model_, terms_, residual_, gaps_, x_);
  progress_.add_roundoff(x_);
}

void GeneralizedAlpha::correct(bool exactly) {
  if (exactly || acts_on_nodes(model_, terms_)) {
    exact_.solve({next_, terms_, vdot_next_, motion_, coefficients_}, residual_,
                 matrix_, x_);
  } else {
    matrix_.solve(model_, terms_, residual_, x_);
  }
}

// Marks the groups as done in which the last correction leaves no more than the
// limit; by factors that earlier steps have measured, at their contraction.
void GeneralizedAlpha::judge_early(bool keeps) {
  std::vector<GroupProgress>& groups = progress_.groups();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const CorrectionSize& now = groups[g].now;
    const CorrectionSize& limit = groups[g].limit;
    const bool is_foreseen =
        keeps && now.value <= kSamePlace * groups[g].motion;
    const FactorPlan::Rest rest =
        is_foreseen ? plan_.expect_rest(course_.count - 1, g, now)
                    : FactorPlan::Rest{now.rigid, now.modal};
    groups[g].is_done = rest.rigid <= limit.rigid && rest.modal <= limit.modal;
  }
}

// Newton's method from the prediction.
void GeneralizedAlpha::converge(const SystemState& from, double h, double end,
                                bool keeps, Corrections corrections,
                                StepResult& result) {
  bool exactly = corrections != Corrections::by_factors;
  const bool has_trend = trend_step_ > 0.0 && model_.nodal_count == 0;
  const bool rotates = predict(from, h, end);
  progress_.start(next_, motion_);
  course_.clear();
  bool knows_noise = false;
  // Factors of an unreduced body are in its axes, and cheap to rotate.
  bool needs_factors = !keeps || rotates;
  int slow_corrections = 0;  // with fresh factors
  int growing = 0;           // corrections in a row
  for (int iteration = 1;; ++iteration) {
    calc_terms(model_, next_, Side::left, terms_, WrenchSource::iterate);
    calc_residual(model_, vdot_next_, terms_, residual_);
    needs_factors = needs_factors || !matrix_.knows_pairs(terms_);
    const bool is_fresh = needs_factors;
    if (needs_factors) renew_factors(h, end, result);
    correct(exactly);
    progress_.include(x_, corrections == Corrections::exact_halved ||
                              acts_on_nodes(model_, terms_) ||
                              (exactly && has_points(terms_)));
    course_.add(progress_.sizes());
    ++result.iterations;
    if (!progress_.is_finite()) {
      fail(from, h, "the motion is no longer finite");
    }
    const bool halves =
        corrections == Corrections::exact_halved && progress_.reverses_last();
    apply_increments(h, halves ? kReversedFraction : 1.0);
    advance(from, h, end);
    progress_.measure_motion(next_, terms_, motion_);
    if (halves && iteration < settings_.max_iterations) continue;
    set_limits(has_trend);
    judge_early(keeps && result.factorizations == 0);
    if (progress_.is_done()) return;
    needs_factors = exactly;
    if (iteration == 1 && settings_.max_iterations > 1) continue;
    progress_.judge();
    if (!knows_noise && progress_.may_be_noise(kPoorContraction)) {
      add_wrench_noise();
      knows_noise = true;
      progress_.judge();
    }
    const std::optional<double> contraction =
        progress_.find_contraction(kPoorContraction);
    course_.include(contraction);
    if (progress_.is_done()) return;
    if (iteration >= settings_.max_iterations) {
      fail(from, h, "Newton's method did not converge");
    }
    growing = contraction > 1.0 ? growing + 1 : 0;
    if (exactly && growing >= kMostGrowing) {
      fail(from, h, "Newton's method diverged");
    }
    const bool is_slow = contraction > kPoorContraction;
    if (is_slow && is_fresh) ++slow_corrections;
    exactly = exactly || slow_corrections >= kSlowCorrections;
    needs_factors = exactly || is_slow;
  }
}

// Where the factors cause a divergence, exact corrections may converge; where
// these alternate between the two slopes of a law with a kink, halved ones.
void GeneralizedAlpha::converge_somehow(const SystemState& from, double h,
                                        double end, bool keeps,
                                        StepResult& result) {
  for (const Corrections corrections :
       {Corrections::by_factors, Corrections::exact,
        Corrections::exact_halved}) {
    const bool is_first = corrections == Corrections::by_factors;
    try {
      converge(from, h, end, keeps && is_first, corrections, result);
      if (!is_first) {
        course_.clear();
        course_.slowest = 1.0;
      }
      return;
    } catch (const NumericalError&) {
      restore_wrenches();
      if (corrections == Corrections::exact_halved) throw;
    }
  }
}

StepResult GeneralizedAlpha::step(SystemState& state, double h, double end) {
  set_coefficients(h);
  fit_memory(h);
  StepResult result;
  const bool keeps = plan_.keeps() && factored_step_ > 0.0 &&
                     std::abs(h - factored_step_) <= 1e-9 * h;
  extrapolate_wrenches(h);
  converge_somehow(state, h, end, keeps, result);
  plan_.finish_step(keeps, course_);
  work_.advance(state, next_, terms_, h, result);
  if (scale_) estimate_error(h, result);
  store_constraint_wrenches(terms_, 1.0, end, next_);
  std::swap(a_, a_next_);
  std::swap(vdot_, vdot_next_);
  trend_step_ = h;
  std::swap(state, next_);
  return result;
}

void GeneralizedAlpha::undo(const SystemState& /*before*/) {
  std::swap(a_, a_next_);
  std::swap(vdot_, vdot_next_);
  trend_step_ = 0.0;
  work_.undo();
}

}  // namespace limber::dynamics
