// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/linear_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/kinematics.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {
namespace {

constexpr double kLarge = 0.1;  // of the body's size: gives a warning
constexpr double kAbsurdDeformation = 1.0;  // of it: gives an error
constexpr double kHarmless = 0.5;           // of the lowest frequency
// Above this the error of second order in the modes exceeds a percent [rad].
constexpr double kLargeTurn = 0.4;

// The mode that moves points most.
Eigen::Index find_largest_mode(const DisplacementMeasure& measure,
                               const VectorX& eta) {
  Eigen::Index k = 0;
  measure.mode_sizes().cwiseProduct(eta.cwiseAbs()).maxCoeff(&k);
  return k;
}

// Largest eigenvalue of B against the stiffness of the undeformed body.
double find_largest_share(const flexbody::ModalElasticity& elasticity,
                          const MatrixX& B) {
  MatrixX scaled;
  if (flexbody::is_diagonal_at_rest(elasticity)) {
    const VectorX scale =
        flexbody::rest_stiffness(elasticity).cwiseSqrt().cwiseInverse();
    scaled = scale.asDiagonal() * B * scale.asDiagonal();
  } else {
    MatrixX K(B.rows(), B.cols());
    flexbody::calc_elastic_tangent(elasticity, VectorX::Zero(B.rows()), K);
    const auto own = dense::find_eigenpairs(K);
    const MatrixX to_unit =
        own.vectors * own.values.cwiseSqrt().cwiseInverse().asDiagonal();
    scaled = to_unit.transpose() * B * to_unit;
  }
  return dense::find_eigenvalues(scaled).maxCoeff();
}

// The theory that holds for small deformations only.
std::string name_limit(const BodyModel& body) {
  if (body.fidelity == Fidelity::nonlinear) {
    return "motion of second order in a body's modes";
  }
  return flexbody::is_linear(body.elasticity)
             ? "linear elasticity"
             : "motion that is linear in a body's modes";
}

// Behaviour of a body beyond the critical speed of its undeformed shape.
const char* tell_beyond(const flexbody::ModalElasticity& elasticity) {
  return flexbody::is_linear(elasticity)
             ? "its deformation grows without bound; level full includes the "
               "stiffening of a real body"
             : "it leaves its undeformed shape; level full tells how far";
}

// Largest rotation of an interface relative to the mean-axis frame [rad].
double find_turn(const SystemModel& model, const SystemState& state,
                 std::size_t body) {
  double turn = 0.0;
  const double* eta = state.eta.data() + model.bodies[body].offset;
  for (const Attachment& attachment : model.attachments) {
    if (!attachment.second || attachment.body != static_cast<int>(body)) {
      continue;
    }
    Matrix3X Phi_B = attachment.Phi_B;
    Matrix3X Psi_B = attachment.Psi_B;
    flexbody::add_slopes(*attachment.second, eta, Phi_B, Psi_B);
    const Vector3 psi =
        0.5 * (combine(attachment.Psi_B, eta) + combine(Psi_B, eta));
    turn = std::max(turn, psi.norm());
  }
  return turn;
}

}  // namespace

double find_softening(const BodyModel& body, const Vector3& w_WB_B) {
  if (body.modes == 0 || body.clamped || body.fidelity != Fidelity::coupled) {
    return 0.0;
  }
  const double lowest = flexbody::lowest_rest_stiffness(body.elasticity);
  if (!(w_WB_B.squaredNorm() > kHarmless * kHarmless * lowest)) return 0.0;
  const Vector6 half_w_squared = half_square(w_WB_B);
  MatrixX B(body.modes, body.modes);
  for (int k = 0; k < body.modes; ++k) {
    for (int l = 0; l < body.modes; ++l) {
      B(k, l) = half_w_squared.dot(body.inertia->J2.block<6, 1>(6 * k, l));
    }
  }
  return find_largest_share(body.elasticity, B);
}

std::optional<std::string> describe_softening(const BodyModel& body,
                                              const Vector3& w_WB_B) {
  const double mu = find_softening(body, w_WB_B);
  if (!(mu >= 1.0)) return std::nullopt;
  const double speed = w_WB_B.norm();
  return fmt::format(
      "body '{}' turns at {:.4g} rad/s, above its critical speed of {:.4g} "
      "rad/s in linear elasticity: its effective stiffness is below zero and "
      "{}",
      body.name, speed, speed / std::sqrt(mu), tell_beyond(body.elasticity));
}

std::optional<std::string> describe_large_turn(const SystemModel& model,
                                               const SystemState& state,
                                               std::size_t body) {
  if (model.bodies[body].fidelity != Fidelity::nonlinear) return std::nullopt;
  const double turn = find_turn(model, state, body);
  if (!(turn > kLargeTurn)) return std::nullopt;
  return fmt::format(
      "body '{}' has bent until an interface turned by {:.3g} rad, where level "
      "nonlinear holds up to {:g} rad; smaller loads and speeds, pieces or "
      "level full may help",
      model.bodies[body].name, turn, kLargeTurn);
}

LinearLimit::LinearLimit(const SystemModel& model) : model_(model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (body.modes == 0 || !body.reduced) continue;
    bodies_.push_back(
        {b, body.reduced->size.maxCoeff(), DisplacementMeasure(body)});
  }
}

void LinearLimit::check_deformation(const SystemState& state, Body& body,
                                    std::vector<std::string>& warnings) const {
  const BodyModel& model = model_.bodies[body.index];
  const VectorX eta = state.eta.segment(model.offset, model.modes);
  const double bound = body.measure.mode_sizes().dot(eta.cwiseAbs());
  if (bound <= kLarge * body.size || body.size == 0.0) return;
  const double deformation = body.measure.calc_displacement(eta);
  if (deformation <= kLarge * body.size) return;
  const bool is_nonlinear = model.fidelity == Fidelity::nonlinear;
  const double turn = is_nonlinear ? find_turn(model_, state, body.index) : 0.0;
  if (is_nonlinear && turn <= kLargeTurn && deformation <= body.size) return;
  const Eigen::Index mode = find_largest_mode(body.measure, eta);
  const std::string what = fmt::format(
      "body '{}' at t = {:.9g} s: deformed by {:.3g} m, {:.3g} % of its size "
      "({:.3g} m), most in mode {} ({:.4g} Hz)",
      model.name, state.t, deformation, 100.0 * deformation / body.size,
      body.size, mode + 1,
      std::sqrt(flexbody::rest_stiffness(model.elasticity)[mode]) /
          (2.0 * std::numbers::pi));
  if (!(deformation <= kAbsurdDeformation * body.size)) {
    const auto soft =
        describe_softening(model, state.bodies[body.index].w_WB_B);
    throw NumericalError(
        what + ": " + name_limit(model) + " has no answer there" +
        (soft ? "; " + *soft
              : "; smaller loads, a stiffer body or level full may help"));
  }
  if (body.was_told_large) return;
  body.was_told_large = true;
  if (is_nonlinear) {
    warnings.push_back(fmt::format(
        "{}, and turned by {:.3g} rad at an interface: beyond {:g} rad level "
        "nonlinear is not to be trusted; level full has large deformations",
        what, turn, kLargeTurn));
    return;
  }
  warnings.push_back(what + ": beyond 10 % " + name_limit(model) +
                     " is not to be trusted; level full has large "
                     "deformations");
}

void LinearLimit::check_speed(const SystemState& state, Body& body,
                              std::vector<std::string>& warnings) const {
  if (body.was_told_soft) return;
  const auto text = describe_softening(model_.bodies[body.index],
                                       state.bodies[body.index].w_WB_B);
  if (!text) return;
  body.was_told_soft = true;
  warnings.push_back(fmt::format("at t = {:.9g} s {}", state.t, *text));
}

void LinearLimit::check(const SystemState& state,
                        std::vector<std::string>& warnings) {
  for (Body& body : bodies_) {
    check_speed(state, body, warnings);
    check_deformation(state, body, warnings);
  }
}

void LinearLimit::exchange_memory(Archive& archive) {
  for (Body& body : bodies_) archive(body.was_told_large, body.was_told_soft);
}

}  // namespace limber::dynamics
