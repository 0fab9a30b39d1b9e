// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/linear_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/terms/kinematics.hpp"

namespace limber::dynamics {
namespace {

constexpr double kLarge = 0.1;  // of the body's size: gives a warning
constexpr double kAbsurdDeformation = 1.0;  // of it: gives an error
constexpr double kHarmless = 0.5;           // of the lowest frequency
// Above this the error of second order in the modes exceeds a percent [rad].
constexpr double kLargeRotation = 0.4;

// The mode that moves points most.
Eigen::Index find_largest_mode(const DisplacementMeasure& measure,
                               const VectorX& eta) {
  Eigen::Index k = 0;
  measure.mode_sizes().cwiseProduct(eta.cwiseAbs()).maxCoeff(&k);
  return k;
}

// Eigenvalues of B against the stiffness of the undeformed body.
VectorX find_fractions(const flexbody::ModalElasticity& elasticity,
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
  return dense::find_eigenvalues(scaled);
}

// [rad^2/s^2]; beyond this square of a spin rotation may soften a body.
double find_harmless_square(const BodyModel& body) {
  if (body.modes == 0 || body.is_held() || !is_coupled(body.fidelity) ||
      is_quadratic(body)) {
    return std::numeric_limits<double>::infinity();
  }
  const double lowest = flexbody::lowest_rest_stiffness(body.elasticity);
  return kHarmless * kHarmless * lowest;
}

// Fractions of stiffness that a spin with these products cancels.
VectorX find_fractions(const BodyModel& body, const Vector6& half_w_squared) {
  MatrixX B(body.modes, body.modes);
  for (int k = 0; k < body.modes; ++k) {
    for (int l = 0; l < body.modes; ++l) {
      B(k, l) = half_w_squared.dot(body.inertia->J2(k).row(l));
    }
  }
  return find_fractions(body.elasticity, B);
}

// The largest magnitude of a fraction for each product of spins [s^2/rad^2].
Vector6 find_unit_fractions(const BodyModel& body) {
  Vector6 units;
  for (int i = 0; i < 6; ++i) {
    units[i] =
        find_fractions(body, Vector6(Vector6::Unit(i))).cwiseAbs().maxCoeff();
  }
  return units;
}

// The theory that holds for small deformations only.
std::string name_limit(const BodyModel& body) {
  if (is_quadratic(body)) {
    return "motion of second order in a body's modes";
  }
  return flexbody::is_linear(body.elasticity)
             ? "linear elasticity"
             : "motion that is linear in a body's modes";
}

// Behaviour of a body beyond the critical speed of its undeformed shape.
const char* describe_beyond(const flexbody::ModalElasticity& elasticity) {
  return flexbody::is_linear(elasticity)
             ? "its deformation grows without bound; level full includes the "
               "stiffening of a real body"
             : "it leaves its undeformed shape; level full shows how far";
}

// Largest rotation of an interface relative to the mean-axis frame [rad].
double find_rotation(const SystemModel& model, const SystemState& state,
                     std::size_t body) {
  double rotation = 0.0;
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
    rotation = std::max(rotation, psi.norm());
  }
  return rotation;
}

}  // namespace

double find_softening(const BodyModel& body, const Vector3& w_WB_B) {
  if (!(w_WB_B.squaredNorm() > find_harmless_square(body))) return 0.0;
  return find_fractions(body, half_square(w_WB_B)).maxCoeff();
}

std::optional<std::string> describe_softening(const BodyModel& body,
                                              const Vector3& w_WB_B) {
  const double mu = find_softening(body, w_WB_B);
  if (!(mu >= 1.0)) return std::nullopt;
  const double speed = w_WB_B.norm();
  return fmt::format(
      "body '{}' rotates at {:.4g} rad/s, above its critical speed of {:.4g} "
      "rad/s in linear elasticity: its effective stiffness is below zero and "
      "{}",
      body.name, speed, speed / std::sqrt(mu),
      describe_beyond(body.elasticity));
}

std::optional<std::string> describe_large_rotation(const SystemModel& model,
                                                   const SystemState& state,
                                                   std::size_t body) {
  if (!is_quadratic(model.bodies[body])) return std::nullopt;
  const double rotation = find_rotation(model, state, body);
  if (!(rotation > kLargeRotation)) return std::nullopt;
  return fmt::format(
      "body '{}' has bent until an interface rotated by {:.3g} rad; level "
      "nonlinear is valid up to {:g} rad; smaller loads and speeds, pieces or "
      "level full may help",
      model.bodies[body].name, rotation, kLargeRotation);
}

LinearLimit::LinearLimit(const SystemModel& model) : model_(model) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    if (body.modes == 0 || !body.reduced) continue;
    bodies_.push_back({b, body.reduced->size.maxCoeff(),
                       find_harmless_square(body), DisplacementMeasure(body)});
    bodies_.back().eta = VectorX::Zero(body.modes);
  }
}

bool LinearLimit::may_exceed(const SystemState& state, Body& body,
                             double limit) const {
  const BodyModel& model = model_.bodies[body.index];
  const auto eta = state.eta.segment(model.offset, model.modes);
  const VectorX& sizes = body.measure.mode_sizes();
  if (sizes.dot(eta.cwiseAbs()) <= limit) return false;
  const double change = sizes.dot((eta - body.eta).cwiseAbs());
  if (body.displacement + change <= limit) return false;
  body.eta = eta;
  body.displacement = body.measure.calc_displacement(body.eta);
  return !(body.displacement <= limit);
}

void LinearLimit::check_deformation(const SystemState& state, Body& body,
                                    std::vector<std::string>& warnings) const {
  if (body.size == 0.0) return;
  const double fraction = body.was_reported_large ? kAbsurdDeformation : kLarge;
  if (!may_exceed(state, body, fraction * body.size)) return;
  const BodyModel& model = model_.bodies[body.index];
  const double deformation = body.displacement;
  const bool is_nonlinear = is_quadratic(model);
  const double rotation =
      is_nonlinear ? find_rotation(model_, state, body.index) : 0.0;
  if (is_nonlinear && rotation <= kLargeRotation && deformation <= body.size)
    return;
  const Eigen::Index mode = find_largest_mode(body.measure, body.eta);
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
        what + ": " + name_limit(model) + " is not valid there" +
        (soft ? "; " + *soft
              : "; smaller loads, a stiffer body or level full may help"));
  }
  if (body.was_reported_large) return;
  body.was_reported_large = true;
  if (is_nonlinear) {
    warnings.push_back(fmt::format(
        "{}, and rotated by {:.3g} rad at an interface: beyond {:g} rad level "
        "nonlinear is not reliable; use level full for large deformations",
        what, rotation, kLargeRotation));
    return;
  }
  warnings.push_back(what + ": beyond 10 % " + name_limit(model) +
                     " is not reliable; use level full for large deformations");
}

bool LinearLimit::may_soften(const SystemState& state, Body& body) const {
  const Vector3& w_WB_B = state.bodies[body.index].w_WB_B;
  if (!(w_WB_B.squaredNorm() > body.harmless_square)) return false;
  const BodyModel& model = model_.bodies[body.index];
  if (!body.unit_fractions) body.unit_fractions = find_unit_fractions(model);
  const Vector6 products = half_square(w_WB_B);
  const double change =
      body.unit_fractions->dot((products - body.products).cwiseAbs());
  if (body.softening + change < 1.0) return false;
  body.products = products;
  body.softening = find_fractions(model, products).maxCoeff();
  return body.softening >= 1.0;
}

void LinearLimit::check_speed(const SystemState& state, Body& body,
                              std::vector<std::string>& warnings) const {
  if (body.was_reported_soft || !may_soften(state, body)) return;
  const auto text = describe_softening(model_.bodies[body.index],
                                       state.bodies[body.index].w_WB_B);
  if (!text) return;
  body.was_reported_soft = true;
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
  for (Body& body : bodies_)
    archive(body.was_reported_large, body.was_reported_soft);
}

}  // namespace limber::dynamics
