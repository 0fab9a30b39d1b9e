// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/generalized_alpha.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "dynamics/archives.hpp"
#include "dynamics/full_turn.hpp"
#include "dynamics/newton_failure.hpp"

namespace limber::dynamics {
namespace {

// Factors of an earlier step are kept while they contract at least this fast;
// a step for which they do not is followed by steps with factors of their own,
// more of them each time that keeping them fails again.
constexpr double kGoodContraction = 1e-3;
constexpr int kFewestFreshSteps = 8;
constexpr int kMostFreshSteps = 512;
// Factor anew within a step when it is slower than this.
constexpr double kPoorContraction = 0.3;
// So many corrections that are slower with fresh factors call for the exact
// derivative.
constexpr int kSlowCorrections = 2;
// Exact corrections in a row that grow: there is no convergence.
constexpr int kMostGrowing = 4;

}  // namespace

GeneralizedAlpha::GeneralizedAlpha(const SystemModel& model,
                                   const Settings& settings)
    : model_(model),
      settings_(settings),
      am_(settings.implicit_euler
              ? 0.0
              : (2.0 * settings.rho_inf - 1.0) / (settings.rho_inf + 1.0)),
      af_(settings.implicit_euler
              ? 0.0
              : settings.rho_inf / (settings.rho_inf + 1.0)),
      gamma_(settings.implicit_euler ? 1.0 : 0.5 + af_ - am_),
      beta_(settings.implicit_euler ? 1.0
                                    : 0.25 * (0.5 + gamma_) * (0.5 + gamma_)),
      lag_(settings.implicit_euler ? 0.0 : 0.5 - beta_),
      matrix_(model),
      exact_(model),
      damper_work_(model),
      next_(make_state(model)),
      terms_(make_terms(model)),
      residual_(VectorX::Zero(NewtonMatrix::size(model))),
      x_(VectorX::Zero(NewtonMatrix::size(model))),
      kept_wrenches_(model.couplers.size() + model.transmissions.size(),
                     Vector6::Zero()),
      gaps_(kept_wrenches_) {
  next_fresh_steps_ = kFewestFreshSteps;
  a_ = a_next_ = vdot_ = vdot_next_ = inc_ = make_rates(model);
  if (settings.estimates_error) scale_.emplace(model);
}

void GeneralizedAlpha::refresh() {
  factored_step_ = 0.0;
  renews_full_ = true;
}

void GeneralizedAlpha::exchange_memory(Archive& archive,
                                       const SystemState& state) {
  archive(a_, vdot_, memory_step_, power_load_, power_loss_, fresh_steps_,
          next_fresh_steps_);
  damper_work_.exchange_memory(archive);
  for (CouplerTerms& coupler : terms_.couplers) archive(coupler.applied);
  for (TransmissionTerms& t : terms_.transmissions) archive(t.applied);
  if (archive.reads()) next_ = state;
}

// a_n as steps of `h` have it.
void GeneralizedAlpha::fit_memory(double h) {
  constexpr double kSame = 1e-9;
  // More than this would multiply round-off more than it mends.
  constexpr double kMostGrowth = 4.0;
  const double ratio = memory_step_ > 0.0 ? h / memory_step_ : 1.0;
  memory_step_ = h;
  if (std::abs(ratio - 1.0) <= kSame) return;
  const double share = ratio <= kMostGrowth ? ratio : 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    a_.translation[b] = vdot_.translation[b] +
                        share * (a_.translation[b] - vdot_.translation[b]);
    a_.rotation[b] =
        vdot_.rotation[b] + share * (a_.rotation[b] - vdot_.rotation[b]);
  }
  a_.modes = vdot_.modes + share * (a_.modes - vdot_.modes);
  a_.nodes = vdot_.nodes + share * (a_.nodes - vdot_.nodes);
}

void GeneralizedAlpha::estimate_error(double h, StepResult& result) const {
  const double constant = 1.0 / 6.0 - beta_ - 0.5 * (am_ - af_);
  const MotionScale::Largest largest =
      scale_->measure_change(a_, a_next_, constant * h * h);
  result.error = largest.displacement;
  result.error_body = largest.body;
}

void GeneralizedAlpha::set_coefficients(double h) {
  coefficients_.acceleration = (1.0 - am_) / ((1.0 - af_) * beta_ * h * h);
  coefficients_.velocity = gamma_ / (beta_ * h);
}

void GeneralizedAlpha::refactor(bool renews_full) {
  matrix_.factor(model_, next_, terms_, inc_.rotation, coefficients_,
                 renews_full || renews_full_);
  renews_full_ = false;
}

// Accelerations that the residual calls for: M^-1 of it for motion that the
// step resolves, the quasi-static share for what is too stiff.
void GeneralizedAlpha::add_quasi_static_accelerations() {
  for (Vector3& rotation : inc_.rotation) rotation.setZero();
  refactor();
  factored_step_ = 0.0;
  matrix_.solve(model_, terms_, residual_, x_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const double* x = x_.data() + 6 * b + static_cast<std::size_t>(body.offset);
    const double c = coefficients_.acceleration;
    const Vector3 translation = c * Eigen::Map<const Vector3>(x);
    const Vector3 rotation = c * Eigen::Map<const Vector3>(x + 3);
    const auto modes = c * Eigen::Map<const VectorX>(x + 6, body.modes);
    a_.translation[b] += translation;
    vdot_.translation[b] += translation;
    a_.rotation[b] += rotation;
    vdot_.rotation[b] += rotation;
    a_.modes.segment(body.offset, body.modes) += modes;
    vdot_.modes.segment(body.offset, body.modes) += modes;
  }
  const auto nodes = coefficients_.acceleration * x_.tail(model_.nodal_count);
  a_.nodes += nodes;
  vdot_.nodes += nodes;
}

void GeneralizedAlpha::start(const SystemState& state, double h) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    a_.translation[b].setZero();
    a_.rotation[b].setZero();
  }
  a_.modes.setZero();
  a_.nodes.setZero();
  vdot_ = vdot_next_ = a_;
  memory_step_ = 0.0;
  next_ = state;
  set_coefficients(h);
  calc_terms(model_, next_, Side::right, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  add_quasi_static_accelerations();
  power_load_ = terms_.load_power;
  power_loss_ = terms_.dissipated_power;
  damper_work_.start(terms_);
}

void GeneralizedAlpha::cross_jump(const SystemState& state, double h) {
  next_ = state;
  set_coefficients(h);
  vdot_next_ = vdot_;
  calc_terms(model_, next_, Side::left, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  const VectorX before = residual_;
  calc_forces(model_, next_, Side::right, terms_);
  calc_residual(model_, vdot_next_, terms_, residual_);
  residual_ -= before;
  add_quasi_static_accelerations();
  power_load_ = terms_.load_power;
  power_loss_ = terms_.dissipated_power;
  damper_work_.start(terms_);
}

// The step's end that a_next_ implies.
void GeneralizedAlpha::advance(const SystemState& from, double h, double end) {
  const double inc_n = h * h * lag_;
  const double inc_next = h * h * beta_;
  const double v_n = h * (1.0 - gamma_);
  const double v_next = h * gamma_;
  const double d_next = (1.0 - am_) / (1.0 - af_);
  const double d_n = am_ / (1.0 - af_);
  const double d_old = af_ / (1.0 - af_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    BodyState& body = next_.bodies[b];
    if (model_.bodies[b].full >= 0) continue;  // follows its nodes
    inc_.translation[b] = h * old.v_WB_W + inc_n * a_.translation[b] +
                          inc_next * a_next_.translation[b];
    inc_.rotation[b] = h * old.w_WB_B + inc_n * a_.rotation[b] +
                       inc_next * a_next_.rotation[b];
    body.p_WB = old.p_WB + inc_.translation[b];
    body.quat_WB = old.quat_WB * exp_quaternion(inc_.rotation[b]);
    body.quat_WB.normalize();
    body.v_WB_W =
        old.v_WB_W + v_n * a_.translation[b] + v_next * a_next_.translation[b];
    body.w_WB_B =
        old.w_WB_B + v_n * a_.rotation[b] + v_next * a_next_.rotation[b];
    vdot_next_.translation[b] = d_next * a_next_.translation[b] +
                                d_n * a_.translation[b] -
                                d_old * vdot_.translation[b];
    vdot_next_.rotation[b] = d_next * a_next_.rotation[b] +
                             d_n * a_.rotation[b] - d_old * vdot_.rotation[b];
  }
  inc_.modes = h * from.etadot + inc_n * a_.modes + inc_next * a_next_.modes;
  next_.eta = from.eta + inc_.modes;
  next_.etadot = from.etadot + v_n * a_.modes + v_next * a_next_.modes;
  vdot_next_.modes =
      d_next * a_next_.modes + d_n * a_.modes - d_old * vdot_.modes;
  if (model_.nodal_count > 0) {
    inc_.nodes = h * from.udot_H + inc_n * a_.nodes + inc_next * a_next_.nodes;
    next_.u_H = from.u_H + inc_.nodes;
    next_.udot_H = from.udot_H + v_n * a_.nodes + v_next * a_next_.nodes;
    vdot_next_.nodes =
        d_next * a_next_.nodes + d_n * a_.nodes - d_old * vdot_.nodes;
  }
  next_.t = end;
}

void GeneralizedAlpha::apply_increments(double h) {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    terms_.couplers[c].applied += matrix_.wrench_increments()[c];
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    terms_.transmissions[i].applied +=
        matrix_.wrench_increments()[model_.couplers.size() + i][0];
  }
  const double share = 1.0 / (beta_ * h * h);
  turn_corrections(model_, next_, x_.tail(model_.nodal_count));
  a_next_.nodes += share * x_.tail(model_.nodal_count);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    if (body.modes > 0) {
      a_next_.modes.segment(body.offset, body.modes) +=
          share * x_.segment(6 * static_cast<Eigen::Index>(b) + body.offset + 6,
                             body.modes);
    }
    if (!body.has_rigid_motion()) continue;
    const double* x = x_.data() + 6 * b + static_cast<std::size_t>(body.offset);
    a_next_.translation[b] += share * Eigen::Map<const Vector3>(x);
    a_next_.rotation[b] += share * (right_jacobian_inverse(inc_.rotation[b]) *
                                    Eigen::Map<const Vector3>(x + 3));
  }
}

void GeneralizedAlpha::fail(const SystemState& from, double h,
                            const CorrectionSize& correction,
                            const char* what) const {
  throw NumericalError(describe(
      {model_, from, terms_, x_, correction, h, next_.t, settings_.tolerance},
      what));
}

void GeneralizedAlpha::plan_factors(bool kept, double slowest) {
  if (!kept) {
    fresh_steps_ = std::max(0, fresh_steps_ - 1);
  } else if (slowest > kGoodContraction) {
    fresh_steps_ = next_fresh_steps_;
    next_fresh_steps_ = std::min(2 * next_fresh_steps_, kMostFreshSteps);
  } else {
    next_fresh_steps_ = kFewestFreshSteps;
  }
}

// Unchanged accelerations, or those that turn unreduced bodies without changing
// their shape, and the step's end that they imply. @returns whether one turns.
bool GeneralizedAlpha::predict(const SystemState& from, double h, double end) {
  const double p_v = 1.0 / (1.0 - am_);
  const double p_a = am_ / (1.0 - am_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    a_next_.translation[b] =
        p_v * vdot_.translation[b] - p_a * a_.translation[b];
    a_next_.rotation[b] = p_v * vdot_.rotation[b] - p_a * a_.rotation[b];
  }
  a_next_.modes = p_v * vdot_.modes - p_a * a_.modes;
  a_next_.nodes = p_v * vdot_.nodes - p_a * a_.nodes;
  const bool turns = predict_turns(model_, from, vdot_.nodes, a_.nodes,
                                   {h, lag_, beta_}, a_next_.nodes);
  next_.memory = from.memory;
  advance(from, h, end);
  return turns;
}

// The wrenches that act at the last state, to begin with once more.
void GeneralizedAlpha::keep_wrenches() {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    kept_wrenches_[c] = terms_.couplers[c].applied;
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    kept_wrenches_[model_.couplers.size() + i][0] =
        terms_.transmissions[i].applied;
  }
}

void GeneralizedAlpha::restore_wrenches() {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    terms_.couplers[c].applied = kept_wrenches_[c];
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    terms_.transmissions[i].applied =
        kept_wrenches_[model_.couplers.size() + i][0];
  }
  factored_step_ = 0.0;
}

// What round-off of stiff wrenches does to the motion, with the factors held.
Roundoff GeneralizedAlpha::measure_wrench_noise() {
  find_roundoff_gaps(model_, terms_, coefficients_.velocity, gaps_);
  residual_.setZero();
  matrix_.solve(model_, terms_, residual_, gaps_, x_);
  const CorrectionSize noise = measure_correction(model_, x_);
  return {noise.rigid, noise.modal};
}

void GeneralizedAlpha::correct(bool exactly) {
  if (exactly) {
    exact_.solve({next_, terms_, vdot_next_, inc_.rotation, coefficients_},
                 residual_, matrix_, x_);
  } else {
    matrix_.solve(model_, terms_, residual_, x_);
  }
}

// Newton's method, from the prediction on. @returns its slowest contraction.
double GeneralizedAlpha::converge(const SystemState& from, double h, double end,
                                  bool keeps, bool exactly,
                                  StepResult& result) {
  const bool turns = predict(from, h, end);
  Roundoff roundoff = measure_roundoff(model_, next_);
  bool knows_noise = false;
  // Those of an unreduced body are in its axes, and cheap to turn.
  bool needs_factors = !keeps || turns;
  CorrectionSize correction;
  double slowest = 0.0;
  int slow_corrections = 0;  // with factors of their own
  int growing = 0;           // corrections in a row
  for (int iteration = 1;; ++iteration) {
    calc_terms(model_, next_, Side::left, terms_, WrenchSource::iterate);
    calc_residual(model_, vdot_next_, terms_, residual_);
    const bool is_fresh = needs_factors;
    if (needs_factors) {
      // What new frames do not mend, new stiffnesses may.
      try {
        refactor(result.factorizations > 0);
      } catch (const NumericalError& error) {
        // It names its own body or coupler; no correction tells of it.
        throw NumericalError(fmt::format(
            "{} (a step of {:.3g} s to t = {:.9g} s)", error.what(), h, end));
      }
      ++result.factorizations;
      factored_step_ = h;
    }
    correct(exactly);
    const CorrectionSize last = correction;
    correction = measure_correction(model_, x_);
    ++result.iterations;
    if (!std::isfinite(correction.value)) {
      fail(from, h, correction, "the motion is no longer finite");
    }
    apply_increments(h);
    advance(from, h, end);
    const double limit = settings_.tolerance * measure_motion(model_, inc_);
    const double contraction =
        iteration > 1 ? correction.value / last.value : 1.0;
    // What a correction leaves, if its own contraction goes on.
    const auto find_rest = [&](double size, double before) {
      const double c = iteration > 1 && before > 0.0 ? size / before : 1.0;
      return c < 0.5 ? size * c / (1.0 - c) : size;
    };
    const auto is_done = [&](double size, double before, double noise) {
      return find_rest(size, before) <= limit || size <= noise;
    };
    const auto has_converged = [&] {
      return is_done(correction.rigid, last.rigid, roundoff.rigid) &&
             is_done(correction.modal, last.modal, roundoff.modal);
    };
    const bool is_slow = iteration > 1 && contraction > kPoorContraction;
    if (!has_converged() && !knows_noise &&
        (is_slow || correction.rigid <= roundoff.rigid)) {
      const Roundoff noise = measure_wrench_noise();
      roundoff.rigid = std::max(roundoff.rigid, noise.rigid);
      roundoff.modal = std::max(roundoff.modal, noise.modal);
      knows_noise = true;
    }
    const bool is_above_noise =
        correction.rigid > roundoff.rigid || correction.modal > roundoff.modal;
    if (iteration > 1 && is_above_noise) {
      slowest = std::max(slowest, contraction);
    }
    if (has_converged()) return slowest;
    if (iteration >= settings_.max_iterations) {
      fail(from, h, correction, "Newton's method did not converge");
    }
    growing = contraction > 1.0 ? growing + 1 : 0;
    if (exactly && growing >= kMostGrowing) {
      fail(from, h, correction, "Newton's method diverged");
    }
    if (is_slow && is_fresh) ++slow_corrections;
    exactly = exactly || slow_corrections >= kSlowCorrections;
    needs_factors = exactly || is_slow;
  }
}

StepResult GeneralizedAlpha::step(SystemState& state, double h, double end) {
  set_coefficients(h);
  fit_memory(h);
  StepResult result;
  const bool keeps = fresh_steps_ == 0 && factored_step_ > 0.0 &&
                     std::abs(h - factored_step_) <= 1e-9 * h;
  double slowest = 1.0;  // contraction with the factors held
  keep_wrenches();
  try {
    slowest = converge(state, h, end, keeps, false, result);
  } catch (const NumericalError&) {
    // The factors alone have thrown it off; their complement may not.
    restore_wrenches();
    try {
      converge(state, h, end, false, true, result);
    } catch (const NumericalError&) {
      restore_wrenches();
      throw;
    }
  }
  plan_factors(keeps, slowest);
  result.load_work = 0.5 * h * (power_load_ + terms_.load_power);
  const double path = damper_work_.advance(state, next_, terms_, h);
  result.dissipated = 0.5 * h * (power_loss_ + terms_.dissipated_power) + path;
  result.begin = {power_load_, power_loss_ + path / h};
  result.end = {terms_.load_power, terms_.dissipated_power + path / h};
  if (scale_) estimate_error(h, result);
  last_power_load_ = power_load_;
  last_power_loss_ = power_loss_;
  power_load_ = terms_.load_power;
  power_loss_ = terms_.dissipated_power;
  std::swap(a_, a_next_);
  std::swap(vdot_, vdot_next_);
  std::swap(state, next_);
  return result;
}

void GeneralizedAlpha::undo() {
  std::swap(a_, a_next_);
  std::swap(vdot_, vdot_next_);
  damper_work_.undo();
  power_load_ = last_power_load_;
  power_loss_ = last_power_loss_;
}

}  // namespace limber::dynamics
