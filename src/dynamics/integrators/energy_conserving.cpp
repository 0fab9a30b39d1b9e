// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/energy_conserving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "common/rotation.hpp"
#include "dynamics/cayley.hpp"
#include "dynamics/equations.hpp"

namespace limber::dynamics {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
// Round-off of a position, relative to its distance from the world origin.
constexpr double kRoundoff = 4.0 * kEpsilon;
// Small inertias and nearly still coordinates make this much more of it.
constexpr double kNoise = 100.0;
// Factor anew when an iteration leaves more than this of a correction: it takes
// many to come to round-off. Fresh factors, only if they leave yet more.
constexpr double kPoorContraction = 0.05;
constexpr double kPoorFreshContraction = 0.1;

double radius_of_gyration_squared(const BodyModel& body) {
  return 0.5 * body.J0.trace() / body.mass;
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
      middle_(make_state(model)),
      next_(make_state(model)),
      turns_(model.bodies.size(), Vector3::Zero()),
      residual_(VectorX::Zero(NewtonMatrix::size(model))),
      x_(VectorX::Zero(NewtonMatrix::size(model))) {
  LIMBER_EXPECT(model.full_bodies.empty());
}

// Bodies go on as they do, modes swing freely, couplers exert what they did.
void EnergyConserving::predict(const SystemState& from, double h) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    middle_.bodies[b].v_WB_W = from.bodies[b].v_WB_W;
    middle_.bodies[b].w_WB_B = from.bodies[b].w_WB_B;
    for (int k = 0; k < body.modes; ++k) {
      const Eigen::Index i = body.offset + k;
      middle_.etadot[i] =
          (from.etadot[i] - 0.5 * h * body.lambda[k] * from.eta[i]) /
          (1.0 + 0.5 * h * body.damping[k] + 0.25 * h * h * body.lambda[k]);
    }
  }
  if (has_wrenches_) return;
  for (std::size_t c = 0; c < mean_.couplers.size(); ++c) {
    mean_.couplers[c].applied = 2.0 * begin_.couplers[c].response.wrench;
  }
  for (std::size_t i = 0; i < mean_.transmissions.size(); ++i) {
    mean_.transmissions[i].applied =
        2.0 * begin_.transmissions[i].response.force;
  }
  has_wrenches_ = true;
}

// The step's end that the mean velocities imply.
void EnergyConserving::advance(const SystemState& from, double h, double end) {
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyState& old = from.bodies[b];
    const BodyState& mean = middle_.bodies[b];
    BodyState& body = next_.bodies[b];
    body = old;
    if (!model_.bodies[b].has_rigid_motion()) continue;
    turns_[b] = h * mean.w_WB_B;
    const Vector3 half = 0.5 * turns_[b];
    body.p_WB = old.p_WB + h * mean.v_WB_W;
    body.quat_WB = old.quat_WB * Quaternion(1.0, half.x(), half.y(), half.z());
    body.quat_WB.normalize();
    body.v_WB_W = 2.0 * mean.v_WB_W - old.v_WB_W;
    body.w_WB_B = 2.0 * mean.w_WB_B - old.w_WB_B;
  }
  next_.eta = from.eta + h * middle_.etadot;
  next_.etadot = 2.0 * middle_.etadot - from.etadot;
  middle_.eta = 0.5 * (from.eta + next_.eta);
  next_.t = end;
}

// Twice the equations: rows as the sums of both ends' forces, for which an
// increment of the end has the derivatives of NewtonMatrix.
void EnergyConserving::calc_body_residual(const SystemState& from, double h,
                                          std::size_t b) {
  const BodyModel& body = model_.bodies[b];
  const BodyTerms& first = begin_.bodies[b];
  const BodyTerms& last = end_.bodies[b];
  const BodyTerms& t = mean_.bodies[b];
  const Vector3& w0 = from.bodies[b].w_WB_B;
  const Vector3& w1 = next_.bodies[b].w_WB_B;
  const auto row = static_cast<Eigen::Index>(6 * b) + body.offset;
  Vector3 pi0 = first.J * w0;
  Vector3 pi1 = last.J * w1;
  const bool is_coupled =
      body.has_rigid_motion() && body.fidelity == Fidelity::coupled;
  const bool is_spun = body.has_rigid_motion() && body.modes > 0 &&
                       body.fidelity >= Fidelity::one_way;
  const Vector6 ww = is_spun ? half_product(w0, w1) : Vector6::Zero().eval();
  for (int k = 0; k < body.modes; ++k) {
    const Eigen::Index i = body.offset + k;
    double change = next_.etadot[i] - from.etadot[i];
    double inertial = is_spun ? ww.dot(body.inertia->J1.col(k)) : 0.0;
    if (is_coupled) {
      pi0 += first.H.col(k) * from.etadot[i];
      pi1 += last.H.col(k) * next_.etadot[i];
      change += last.H.col(k).dot(w1) - first.H.col(k).dot(w0);
      inertial += 0.5 * (ww.dot(first.scratch_J2.segment<6>(6 * k) +
                                last.scratch_J2.segment<6>(6 * k)) -
                         w0.dot(last.scratch_b2.segment<3>(3 * k)) -
                         w1.dot(first.scratch_b2.segment<3>(3 * k)));
    }
    residual_[row + 6 + k] =
        2.0 * (change / h - inertial + body.lambda[k] * middle_.eta[i] +
               body.damping[k] * middle_.etadot[i] - t.modal_force[k]);
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
  calc_step_forces(model_, from, middle_, begin_, end_, {from.t, next_.t, h},
                   motion_, mean_);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    calc_body_residual(from, h, b);
  }
}

void EnergyConserving::factor() {
  matrix_.factor(model_, middle_, mean_, turns_, coefficients_, false, &end_);
}

// Increments are of R exp(x); Cayley's turn changes by this.
Vector3 EnergyConserving::change_turn(std::size_t b, const Vector3& x) const {
  return cayley_jacobian_inverse(turns_[b]) * x;
}

void EnergyConserving::apply_increments(double h) {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    mean_.couplers[c].applied += matrix_.wrench_increments()[c];
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    mean_.transmissions[i].applied +=
        matrix_.wrench_increments()[model_.couplers.size() + i][0];
  }
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const auto row = static_cast<Eigen::Index>(6 * b) + body.offset;
    middle_.etadot.segment(body.offset, body.modes) +=
        x_.segment(row + 6, body.modes) / h;
    if (!body.has_rigid_motion()) continue;
    middle_.bodies[b].v_WB_W += x_.segment<3>(row) / h;
    middle_.bodies[b].w_WB_B += change_turn(b, x_.segment<3>(row + 3)) / h;
  }
}

// Length [m] of the increments, of turns as the motion has them (a runaway turn
// is almost none of the rotation), mass-weighted within a body; largest body.
EnergyConserving::Size EnergyConserving::measure_increments() const {
  Size largest;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const auto row = static_cast<Eigen::Index>(6 * b) + body.offset;
    const double squared =
        x_.segment<3>(row).squaredNorm() +
        radius_of_gyration_squared(body) *
            change_turn(b, x_.segment<3>(row + 3)).squaredNorm() +
        x_.segment(row + 6, body.modes).squaredNorm() / body.mass;
    if (!(squared <= largest.value)) {
      largest = {squared, b};
      if (!std::isfinite(squared)) break;
    }
  }
  largest.value = std::sqrt(largest.value);
  return largest;
}

// The step's motion on the same scale [m].
double EnergyConserving::measure_motion(double h) const {
  double largest = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    const BodyModel& body = model_.bodies[b];
    const double squared =
        middle_.bodies[b].v_WB_W.squaredNorm() +
        radius_of_gyration_squared(body) *
            middle_.bodies[b].w_WB_B.squaredNorm() +
        middle_.etadot.segment(body.offset, body.modes).squaredNorm() /
            body.mass;
    largest = std::max(largest, squared);
  }
  return h * std::sqrt(largest);
}

// Below this [m] corrections may be made of round-off alone.
double EnergyConserving::measure_roundoff() const {
  double reach = 0.0;
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    reach = std::max(reach, next_.bodies[b].p_WB.squaredNorm() +
                                radius_of_gyration_squared(model_.bodies[b]));
  }
  return kRoundoff * std::sqrt(reach);
}

StepResult EnergyConserving::step(SystemState& state, double h, double end) {
  coefficients_ = {4.0 / (h * h), 2.0 / h};
  next_.memory = state.memory;
  calc_terms(model_, state, Side::right, begin_);
  predict(state, h);
  advance(state, h, end);
  const double roundoff = measure_roundoff();
  bool needs_factors = !(std::abs(h - factored_step_) <= 1e-9 * h);
  StepResult result;
  double last = 0.0;
  Size correction;
  const auto fail = [&](const Size& size, const char* what) {
    factored_step_ = 0.0;
    has_wrenches_ = false;
    throw NumericalError(fmt::format(
        "body '{}' at t = {:.9g} s: {} (last correction {:.3g} m, tolerance "
        "{:.3g} of the step's motion); a smaller step may help",
        model_.bodies[size.body].name, end, what, size.value,
        settings_.tolerance));
  };
  while (true) {
    calc_residual(state, h);
    if (needs_factors) {
      try {
        factor();
      } catch (const NumericalError&) {
        fail(correction, "Newton's method diverged");
      }
      ++result.factorizations;
      factored_step_ = h;
      needs_factors = false;
    }
    matrix_.solve(model_, mean_, residual_, x_);
    correction = measure_increments();
    ++result.iterations;
    if (!std::isfinite(correction.value)) {
      fail(correction, "the motion is no longer finite");
    }
    apply_increments(h);
    advance(state, h, end);
    const double motion = measure_motion(h);
    const double contraction =
        result.iterations > 1 ? correction.value / last : 1.0;
    last = correction.value;
    // What is left after this correction, if the contraction goes on.
    const double left =
        contraction < 0.5 ? correction.value * contraction / (1.0 - contraction)
                          : correction.value;
    const double noise =
        std::max(kNoise * roundoff, settings_.tolerance * motion);
    if (left <= 0.25 * kEpsilon * motion) break;
    // Corrections that no longer shrink are round-off.
    if (contraction > 0.5 && correction.value <= noise) break;
    if (result.iterations >= settings_.max_iterations) {
      if (left <= noise) break;
      fail(correction, "Newton's method did not converge");
    }
    needs_factors =
        result.iterations > 1 && correction.value > roundoff &&
        contraction > (result.factorizations > 0 ? kPoorFreshContraction
                                                 : kPoorContraction);
  }
  result.load_work = h * mean_.load_power;
  result.dissipated = h * mean_.dissipated_power;
  std::swap(state, next_);
  return result;
}

}  // namespace limber::dynamics
