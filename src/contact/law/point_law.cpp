// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/point_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/restitution.hpp"
#include "limber/contact/law/impact_estimate.hpp"
#include "limber/contact/law/point_tangent.hpp"

namespace limber::contact {
namespace {

// Slower touches begin as one of this speed [m/s].
constexpr double kLeastTouchSpeed = 1e-5;

PointMemory remembered(const PointLaw& law, const PointMotion& motion,
                       const PointMemory& memory) {
  if (memory.is_touching()) return memory;
  return law.begin(law.find_law(motion.curvature, motion.residual),
                   motion.rate());
}

}  // namespace

PointLaw::PointLaw(const ContactParameters& parameters,
                   const std::optional<PairModuli>& moduli, double mass,
                   double size)
    : parameters_(parameters),
      moduli_(moduli),
      mass_(mass),
      size_(size),
      has_friction_(parameters.friction.sliding + parameters.friction.excess >
                    0.0),
      tangential_ratio_(moduli ? moduli->tangential_ratio()
                               : kDefaultTangentialRatio) {
  check(parameters);
  if (!parameters.damping) {
    factor_ = find_restitution_factor(parameters.restitution);
  }
  LIMBER_EXPECT(mass > 0.0 && std::isfinite(mass));
  LIMBER_EXPECT(size > 0.0);
}

HertzLaw PointLaw::find_law(double curvature, double residual,
                            double share) const {
  if (parameters_.stiffness) {
    return HertzLaw({share * *parameters_.stiffness, residual / share});
  }
  if (!moduli_) {
    const HertzLaw::Parameters whole = make_default_law(mass_).parameters();
    return HertzLaw({share * whole.stiffness, whole.residual / share});
  }
  const double stiffness =
      find_hertz_stiffness(moduli_->normal, find_radius(curvature));
  return HertzLaw({share * stiffness, residual / share});
}

double PointLaw::find_radius(double curvature) const {
  return parameters_.radius.value_or(1.0 / std::max(curvature, 1.0 / size_));
}

PointMemory PointLaw::begin(const HertzLaw& law, double rate) const {
  PointMemory memory;
  memory.speed = std::max(rate, kLeastTouchSpeed);
  const double v = std::max(memory.speed, kReferenceSpeed);
  memory.tangential_stiffness =
      tangential_ratio_ *
      law.find_state_of_energy(0.5 * mass_ * v * v).stiffness;
  return memory;
}

double PointLaw::find_duration(const HertzLaw& law, double speed) const {
  return estimate_impact(law, mass_, speed).duration;
}

ElasticPoint PointLaw::find_elastic(const PointMotion& motion) const {
  const HertzLaw::Response elastic =
      find_law(motion.curvature, motion.residual, motion.share)
          .evaluate(motion.depth);
  return {.force = {elastic.force, elastic.stiffness, elastic.force},
          .energy = elastic.energy(),
          .area = motion.share * std::numbers::pi *
                  find_radius(motion.curvature) * elastic.hertz_depth};
}

DampingRate PointLaw::find_damping(const TouchMotion& touch) const {
  if (parameters_.damping) return {.s = *parameters_.damping};
  return contact::find_damping(factor_, touch);
}

PointResponse PointLaw::evaluate(const PointMotion& motion,
                                 const ElasticForce& elastic,
                                 const DampingRate& damping,
                                 const PointMemory& memory) const {
  PointResponse out;
  out.next = remembered(*this, motion, memory);
  const double rate = motion.rate();
  const DampedForce pressed = damp(elastic, rate, damping);
  const double grip = std::max(0.0, 1.0 + damping.s * rate);
  out.normal_force = pressed.force;
  out.dissipation = pressed.dissipation;
  out.force_W = pressed.force * motion.normal_W;
  add_friction(motion, pressed, out);
  out.by_elastic_W *= grip;
  out.next.time = motion.time;
  return out;
}

void PointLaw::add_friction(const PointMotion& motion,
                            const DampedForce& pressed,
                            PointResponse& out) const {
  BristleResponse response;
  if (has_friction_) {
    const double k = motion.share * out.next.tangential_stiffness;
    const BristleFriction friction({.limit = parameters_.friction,
                                    .stiffness = k,
                                    .damping = find_bristle_damping(k, mass_)});
    const Matrix3 R_BW = motion.R_WB.transpose();
    response = friction.evaluate(out.next.bristle,
                                 {.normal_S = R_BW * motion.normal_W,
                                  .increment_S = R_BW * motion.increment_W,
                                  .velocity_S = R_BW * motion.velocity_W,
                                  .normal_force = pressed.force});
    const double h = motion.time - out.next.time;
    const double slip_power = h > 0.0 ? response.slip_work / h : 0.0;
    out.friction_W = motion.R_WB * response.force_S;
    out.slips = response.slips;
    out.energy += response.energy;
    out.dissipation += response.damper_power + slip_power;
    out.next.bristle = response.next;
    response.by_increment = motion.R_WB * response.by_increment * R_BW;
    response.by_velocity = motion.R_WB * response.by_velocity * R_BW;
    response.by_normal_force = motion.R_WB * response.by_normal_force;
    out.force_W += out.friction_W;
  }
  const PointTangent tangent =
      find_point_tangent(motion.normal_W, pressed, response);
  out.by_elastic_W = motion.normal_W + response.by_normal_force;
  out.stiffness = tangent.stiffness;
  out.damping = tangent.damping;
}

}  // namespace limber::contact
