// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/energy_conserving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/applied_wrenches.hpp"
#include "limber/dynamics/newton/cayley.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/state_increments.hpp"
#include "limber/dynamics/terms/maxwell.hpp"

namespace limber::dynamics {
namespace {

// Round-off of a step's motion, relative to it [-].
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Small inertias and nearly constant coordinates amplify it by up to this [-].
constexpr double kNoise = 100.0;
// Contraction above which to factor again: by factors of an earlier step, which
// then take three corrections or more to reach round-off, and by those of this
// step [-].
constexpr double kPoorStepContraction = 0.003;
constexpr double kPoorFreshContraction = 0.1;
// Change of the contraction that only round-off causes [-].
constexpr double kStalled = 2.0;
// Largest factor by which a change of velocities is extrapolated [-].
constexpr double kLongestTrend = 2.0;

Eigen::Map<const VectorX> modes_of(const BodyModel& body, const VectorX& all) {
  return {all.data() + body.offset, body.modes};
}

// Components (xx, yy, zz, xy, xz, yz): a' A b / 2 = half_product . pack(A).
Vector6 half_product(const Vector3& a, const Vector3& b) {
  Vector6 q;
  q << a[0] * b[0], a[1] * b[1], a[2] * b[2], a[0] * b[1] + a[1] * b[0],
      a[0] * b[2] + a[2] * b[0], a[1] * b[2] + a[2] * b[1];
  return 0.5 * q;
}

}  // namespace

EnergyConserving::EnergyConserving(const SystemModel& model,
                                   const Settings& settings)
    : model_(model),
      settings_(settings),
      matrix_(model),
      begin_(make_terms(model)),
      end_(make_terms(model)),
      mean_(make_terms(model)),
      motion_(make_step_motion(model)),
      flows_(make_flows(model)),
      maxwell_(model, flexbody::set_middle_step),
      elastic_(VectorX::Zero(model.modal_count)),
      middle_(make_state(model)),
      next_(make_state(model)),
      rotations_(make_unknowns(model)),
      unresolved_(model, settings.damps_unresolved),
      change_(VectorX::Zero(model.modal_count)),
      residual_(rotations_),
      x_(rotations_),
      step_(rotations_),
      courses_{Course{rotations_, 0.0}, Course{rotations_, 0.0}},
      left_(make_state(model)),
      progress_(model) {
  LIMBER_EXPECT(model.nodal_count == 0);
}

// Predicts mean velocities that change as between the last two steps: those of
// motion that the steps do not resolve are near zero, and remain so.
void EnergyConserving::predict(const SystemState& from, double h) {
  const Course& last = courses_[0];
  const Course& before = courses_[1];
  const double growth = (last.h + h) / (last.h + before.h);
  const bool has_trend = last.h > 0.0 && before.h > 0.0 &&
                         growth <= kLongestTrend && continues(from);
  if (!has_trend) return predict_anew(from, h);
  x_ = last.mean + growth * (last.mean - before.mean);
  set_velocities(model_, x_, middle_);
}

// Whether a step begins where the last one ended, at its velocities.
bool EnergyConserving::continues(const SystemState& from) const {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (from.bodies[b].v_WB_W != left_.bodies[b].v_WB_W ||
        from.bodies[b].w_WB_B != left_.bodies[b].w_WB_B) {
      return false;
    }
  }
  return from.t == left_.t && from.etadot == left_.etadot;
}

// Predicts unchanged velocities of bodies, free vibration of modes and the
// wrenches of couplers at the begin.
void EnergyConserving::predict_anew(const SystemState& from, double h) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    middle_.bodies[b].v_WB_W = from.bodies[b].v_WB_W;
    middle_.bodies[b].w_WB_B = from.bodies[b].w_WB_B;
    const VectorX& lambda = flexbody::rest_stiffness(body.elasticity);
    auto elastic = elastic_.segment(body.offset, body.modes);
    if (flexbody::is_diagonal(body.elasticity)) {
      elastic = lambda.cwiseProduct(modes_of(body, from.eta));
    } else {
      flexbody::calc_elastic_force(body.elasticity, modes_of(body, from.eta),
                                   elastic);
    }
    add_maxwell_force(body, from.maxwell, elastic);
    const double stiffness = 1.0 + maxwell_.step_of(b).stiffness;
    for (int k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      middle_.etadot[i] = (from.etadot[i] - 0.5 * h * elastic_[i]) /
                          (1.0 + 0.5 * h * body.damping[k] +
                           0.25 * h * h * stiffness * lambda[k]);
    }
  }
  if (courses_[0].h > 0.0) return;
  for (std::size_t c = 0; c < mean_.couplers.size(); ++c) {
    mean_.couplers[c].applied = 2.0 * begin_.couplers[c].response.wrench;
  }
  for (std::size_t i = 0; i < mean_.transmissions.size(); ++i) {
    mean_.transmissions[i].applied =
        2.0 * begin_.transmissions[i].response.force;
  }
}

void EnergyConserving::keep_course(const SystemState& end, double h) {
  std::swap(courses_[0], courses_[1]);
  get_velocities(model_, middle_, courses_[0].mean);
  courses_[0].h = h;
  left_ = end;
}

// The step's end that the mean velocities imply.
void EnergyConserving::advance(const SystemState& from, double h, double end) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    const BodyState& mean = middle_.bodies[b];
    BodyState& body = next_.bodies[b];
    body = old;
    if (!model_.bodies[b].has_rigid_motion()) continue;
    rotation_rows(model_.bodies[b], rotations_) = h * mean.w_WB_B;
    const Vector3 half = 0.5 * h * mean.w_WB_B;
    body.p_WB = old.p_WB + h * mean.v_WB_W;
    body.quat_WB = old.quat_WB * Quaternion(1.0, half.x(), half.y(), half.z());
    body.quat_WB.normalize();
    body.v_WB_W = 2.0 * mean.v_WB_W - old.v_WB_W;
    body.w_WB_B = 2.0 * mean.w_WB_B - old.w_WB_B;
  }
  next_.eta = from.eta + h * middle_.etadot;
  for (Eigen::Index i = 0; i < next_.etadot.size(); ++i) {
    const double mean = middle_.etadot[i];
    next_.etadot[i] = mean + unresolved_.ratio(i) * (mean - from.etadot[i]);
  }
  middle_.eta = 0.5 * (from.eta + next_.eta);
  maxwell_.advance(from, next_);
  middle_.maxwell = 0.5 * (from.maxwell + next_.maxwell);
  next_.t = end;
}

// Twice the equations: the rows are sums of the forces at both ends, whose
// derivatives with respect to an increment of the end are those of
// NewtonMatrix.
void EnergyConserving::calc_body_residual(const SystemState& from, double h,
                                          std::size_t b) {
  const BodyModel& body = model_.bodies[b];
  const BodyTerms& first = begin_.bodies[b];
  const BodyTerms& last = end_.bodies[b];
  const BodyTerms& t = mean_.bodies[b];
  const Vector3& w0 = from.bodies[b].w_WB_B;
  const Vector3& w1 = next_.bodies[b].w_WB_B;
  const Eigen::Index row = body.row;
  Vector3 pi0 = first.J * w0;
  Vector3 pi1 = last.J * w1;
  const bool is_coupled =
      body.has_rigid_motion() && dynamics::is_coupled(body.fidelity);
  const bool is_spun = body.has_rigid_motion() && body.modes > 0 &&
                       body.fidelity >= Fidelity::one_way;
  const Vector6 ww = is_spun ? half_product(w0, w1) : Vector6::Zero().eval();
  auto elastic = elastic_.segment(body.offset, body.modes);
  if (const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity)) {
    elastic = lambda->cwiseProduct(modes_of(body, middle_.eta));
  } else {
    flexbody::calc_elastic_force_over_step(body.elasticity,
                                           modes_of(body, from.eta),
                                           modes_of(body, next_.eta), elastic);
  }
  add_maxwell_force(body, middle_.maxwell, elastic);
  for (int k = 0; k < body.modes; ++k) {
    const Eigen::Index i = body.offset + k;
    double change = next_.etadot[i] - from.etadot[i];
    double inertial =
        is_spun && !is_coupled ? ww.dot(body.inertia->J1().row(k)) : 0.0;
    if (is_coupled) {
      pi0 += first.H().col(k) * from.etadot[i];
      pi1 += last.H().col(k) * next_.etadot[i];
      change += last.H().col(k).dot(w1) - first.H().col(k).dot(w0);
      inertial = 0.5 * (ww.dot(first.dJ(k) + last.dJ(k)) -
                        w0.dot(last.beta_rate(k)) - w1.dot(first.beta_rate(k)));
    }
    residual_[row + 6 + k] =
        2.0 * (change / h - inertial + elastic_[i] +
               (body.damping[k] + unresolved_.damping(i)) * middle_.etadot[i] -
               t.modal_force[k]);
    change_[i] = change;
  }
  residual_.segment<6>(row).setZero();
  if (!body.has_rigid_motion()) return;
  residual_.segment<3>(row) =
      2.0 * (body.mass * (next_.bodies[b].v_WB_W - from.bodies[b].v_WB_W) / h -
             t.force_W);
  residual_.segment<3>(row + 3) =
      2.0 * ((pi1 - pi0) / h +
             middle_.bodies[b].w_WB_B.cross(0.5 * (pi0 + pi1)) - t.moment_B);
}

void EnergyConserving::calc_residual(const SystemState& from, double h) {
  calc_terms(model_, next_, Side::left, end_);
  calc_step_motion(model_, from, middle_, next_, begin_, end_, h, motion_);
  calc_step_forces(model_, from, middle_, begin_, end_,
                   {from.t, next_.t, h, from.inputs}, motion_, mean_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    calc_body_residual(from, h, b);
  }
}

void EnergyConserving::factor(const SystemState& from) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    if (!has_dense_modes(body)) continue;
    flexbody::calc_elastic_tangent_over_step(
        body.elasticity, modes_of(body, from.eta), modes_of(body, next_.eta),
        mean_.bodies[b].stiffness);
    add_geometric_stiffness(model_, b, mean_, mean_.bodies[b].stiffness);
  }
  matrix_.factor(model_, middle_, mean_, rotations_, coefficients_, false,
                 &end_);
}

// Rotations by Cayley's vector, in which they add up: the rotation itself is
// almost constant when that vector diverges.
void EnergyConserving::turn_increments() {
  for (const BodyModel& body : model_.bodies) {
    const Vector3 rotation = rotation_rows(body, rotations_);
    const Vector3 x = rotation_rows(body, x_);
    rotation_rows(body, x_) = cayley_jacobian_inverse(rotation) * x;
  }
}

void EnergyConserving::apply_increments(double h, double fraction) {
  x_ *= fraction;
  add_to_applied(matrix_.wrench_increments(), mean_, fraction);
  get_velocities(model_, middle_, step_);
  step_ += x_ / h;
  set_velocities(model_, step_, middle_);
}

void EnergyConserving::set_motion(double h) {
  get_velocities(model_, middle_, step_);
  step_ *= h;
}

// Below this length corrections may consist of round-off alone [m].
double EnergyConserving::find_noise(const GroupProgress& group) const {
  return std::max(kNoise * group.roundoff.rigid,
                  settings_.tolerance * group.motion);
}

// Whether a quarter of round-off is left; corrections that no longer shrink, or
// less than the one before did, are round-off.
void EnergyConserving::judge() {
  for (GroupProgress& g : progress_.groups()) {
    const double roundoff = std::max(kRoundoff * g.motion, g.roundoff.step);
    const bool stays = g.before.value > 0.0 && g.contraction() > 0.5;
    const bool stalls = g.contraction() > kStalled * g.contraction_before &&
                        g.now.value <= settings_.tolerance * g.motion;
    g.is_done = 4.0 * g.rest() <= roundoff || stalls ||
                ((g.was_done || stays) && g.now.value <= find_noise(g));
  }
}

// Whether the errors left may be round-off.
bool EnergyConserving::is_noise() const {
  return std::all_of(progress_.groups().begin(), progress_.groups().end(),
                     [this](const GroupProgress& g) {
                       return g.is_done || g.rest() <= find_noise(g);
                     });
}

bool EnergyConserving::contracts_poorly(double poor) const {
  return std::any_of(progress_.groups().begin(), progress_.groups().end(),
                     [poor](const GroupProgress& g) {
                       return !g.is_done && g.now.value > g.roundoff.rigid &&
                              g.contraction() > poor;
                     });
}

void EnergyConserving::fail(double end, const char* what) {
  const CorrectionSize& worst = progress_.find_worst().now;
  refresh();
  throw NumericalError(fmt::format(
      "body '{}' at t = {:.9g} s: {} (last correction {:.3g} m, tolerance "
      "{:.3g} of the step's motion); a smaller step may help",
      model_.bodies[worst.body].name, end, what, worst.value,
      settings_.tolerance));
}

// Of modes that the step does not resolve.
void EnergyConserving::add_losses(const SystemState& from, double h) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    for (int k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      mean_.bodies[b].dissipated +=
          unresolved_.find_loss(i, next_.etadot[i] - from.etadot[i], change_[i],
                                middle_.etadot[i], h);
    }
  }
}

StepResult EnergyConserving::step(SystemState& state, double h, double end) {
  coefficients_ = {4.0 / (h * h), 2.0 / h, &unresolved_.calming()};
  maxwell_.set_step(h, mean_);
  unresolved_.set_step(model_, h);
  copy_step_constants(state, next_);
  calc_terms(model_, state, Side::right, begin_);
  predict(state, h);
  advance(state, h, end);
  set_motion(h);
  progress_.start(next_, step_);
  bool needs_factors = !(std::abs(h - factored_step_) <= 1e-9 * h);
  StepResult result;
  while (true) {
    calc_residual(state, h);
    if (needs_factors || !matrix_.knows_pairs(mean_)) {
      try {
        factor(state);
      } catch (const NumericalError&) {
        fail(end, "Newton's method diverged");
      }
      ++result.factorizations;
      factored_step_ = h;
      needs_factors = false;
    }
    matrix_.solve(model_, mean_, residual_, x_);
    turn_increments();
    progress_.include(x_, true);
    ++result.iterations;
    if (!progress_.is_finite()) fail(end, "the motion is no longer finite");
    const bool is_damped = progress_.reverses_last();
    apply_increments(h, is_damped ? kReversedFraction : 1.0);
    advance(state, h, end);
    set_motion(h);
    progress_.measure_motion(next_, mean_, step_);
    if (is_damped) {
      needs_factors = true;
      if (result.iterations < settings_.max_iterations) continue;
    }
    judge();
    if (progress_.is_done()) break;
    if (result.iterations >= settings_.max_iterations) {
      if (is_noise()) break;
      fail(end, "Newton's method did not converge");
    }
    needs_factors =
        result.iterations > 1 &&
        contracts_poorly(result.factorizations > 0 ? kPoorFreshContraction
                                                   : kPoorStepContraction);
  }
  add_losses(state, h);
  flows_.clear();
  add_powers(mean_, h, flows_);
  set_work(flows_, result);
  store_constraint_wrenches(mean_, 2.0, end - 0.5 * h, next_);
  keep_course(next_, h);
  std::swap(state, next_);
  return result;
}

}  // namespace limber::dynamics
