// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/point_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/restitution.hpp"
#include "limber/contact/law/impact_estimate.hpp"

namespace limber::contact {
namespace {

// Slower touches begin as one of this speed [m/s].
constexpr double kLeastTouchSpeed = 1e-5;

constexpr double kPi = std::numbers::pi;

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
      shells_(LoadShells::Parameters{}) {
  check(parameters);
  if (!parameters.damping) {
    factor_ = find_restitution_factor(parameters.restitution);
  }
  LIMBER_EXPECT(mass > 0.0 && std::isfinite(mass));
  LIMBER_EXPECT(size > 0.0);
  shells_ = make_shells();
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

LoadShells PointLaw::make_shells() const {
  LoadShells::Parameters shells;
  shells.limit = parameters_.friction;
  shells.tangential_ratio =
      moduli_ ? moduli_->tangential_ratio() : kDefaultTangentialRatio;
  if (moduli_) {
    shells.spin_ratio =
        512.0 / (27.0 * kPi * kPi) * moduli_->torsional / moduli_->tangential;
  }
  // As of a depth as large as the shapes.
  const HertzLaw::Parameters law = find_law(1.0 / size_, 0.0).parameters();
  shells.reference_stiffness = std::isfinite(law.stiffness)
                                   ? 1.5 * law.stiffness * std::sqrt(size_)
                                   : 1.0 / law.residual;
  return LoadShells(shells);
}

PointMemory PointLaw::begin(double rate) const {
  PointMemory memory;
  memory.speed = std::max(rate, kLeastTouchSpeed);
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

// d_H = (f / k)^(2/3), df/dd_H = 3 f / (2 d_H)
ShellLoad PointLaw::find_shell_load(const PointMotion& motion,
                                    const ElasticPoint& elastic) const {
  const double f = elastic.force.force;
  if (elastic.flat_stiffness > 0.0) {
    return {.force = f, .stiffness = elastic.flat_stiffness};
  }
  const HertzLaw::Parameters law =
      find_law(motion.curvature, motion.residual, motion.share).parameters();
  return {.force = f,
          .stiffness = 1.5 * std::cbrt(f) * std::pow(law.stiffness, 2.0 / 3.0),
          .exponent = 1.5,
          .residual = law.residual};
}

double PointLaw::find_spin_radius(const PointMotion& motion,
                                  double force) const {
  if (!moduli_) return 0.0;
  return 3.0 * kPi / 16.0 *
         std::cbrt(0.75 * force * find_radius(motion.curvature) /
                   moduli_->normal);
}

PointResponse PointLaw::evaluate(const PointMotion& motion,
                                 const ElasticPoint& elastic,
                                 const DampingRate& damping,
                                 const PointMemory& memory) const {
  PointResponse out;
  out.next = memory.is_touching() ? memory : begin(motion.rate());
  const Vector3& n = motion.normal_W;
  const DampedForce pressed = damp(elastic.force, motion.rate(), damping);
  out.normal_force = pressed.force;
  out.dissipation = pressed.dissipation;
  out.force_W = pressed.force * n;
  out.stiffness = pressed.stiffness * n * n.transpose();
  out.damping = pressed.damping * n * n.transpose();
  out.by_elastic_W = std::max(0.0, 1.0 + damping.s * motion.rate()) * n;
  if (has_friction_) add_friction(motion, elastic, pressed, out);
  out.next.time = motion.time;
  return out;
}

// With d' = -n . v and d = -n . u; the grip g = pressed / elastic force.
void PointLaw::add_friction(const PointMotion& motion,
                            const ElasticPoint& elastic,
                            const DampedForce& pressed,
                            PointResponse& out) const {
  const Vector3& n = motion.normal_W;
  const FrictionFrame frame(n);
  const FrictionMemory& memory = out.next.friction;
  const double N = elastic.force.force;
  if (!(N > 0.0)) {
    out.next.friction = keep_friction({}, frame, motion.turns);
    return;
  }
  ShellLoad load = find_shell_load(motion, elastic);
  load.grip = pressed.force / N;
  const double r_e = find_spin_radius(motion, N);
  const double turn = n.dot(find_turn_W(memory, motion.turns));
  ShellMotion slip;
  slip.increment << frame.plane_W.transpose() * motion.increment_W, r_e * turn;
  slip.velocity << frame.plane_W.transpose() * motion.velocity_W,
      r_e * motion.spin;
  const bool is_flat = load.exponent == 1.0;
  const double damper =
      is_flat ? find_spring_damping(load.stiffness, mass_) : 0.0;
  const ShellResponse shells = shells_.evaluate(
      recall_friction(memory, frame, motion.turns), load, slip, damper);
  const double h = motion.time - out.next.time;
  out.friction_W = frame.plane_W * shells.force.head<2>();
  out.force_W += out.friction_W;
  out.moment = r_e * shells.force[2];
  out.slips = shells.slips;
  out.energy = shells.energy;
  out.rubbed = shells.damper_power;
  out.dissipation += out.rubbed;
  out.slip_power = h > 0.0 ? shells.slip_work / h : 0.0;
  out.next.friction = keep_friction(shells.next, frame, motion.turns);
  // Tangents; r_e is that of the load.
  const double r_by_load = r_e / (3.0 * N);
  const Vector3 by_load =
      shells.by_load + r_by_load * (turn * shells.by_increment.col(2) +
                                    motion.spin * shells.by_velocity.col(2));
  const double grip_by_depth =
      (pressed.stiffness - load.grip * elastic.force.stiffness) / N;
  const Vector3 by_depth =
      elastic.force.stiffness * by_load + grip_by_depth * shells.by_grip;
  const Vector3 by_rate = pressed.damping / N * shells.by_grip;
  const auto& E = frame.plane_W;
  const auto across = [&](const Vector3& by) -> Vector3 {
    return E * by.head<2>();
  };
  out.stiffness +=
      across(by_depth) * n.transpose() -
      E * shells.by_increment.topLeftCorner<2, 2>() * E.transpose();
  out.damping += across(by_rate) * n.transpose() -
                 E * shells.by_velocity.topLeftCorner<2, 2>() * E.transpose();
  out.by_elastic_W += across(by_load);
  out.force_by_turn = r_e * across(shells.by_increment.col(2));
  out.moment_by_turn = r_e * r_e * shells.by_increment(2, 2);
  const double moment_by_depth =
      r_e * by_depth[2] + r_by_load * elastic.force.stiffness * shells.force[2];
  out.moment_by_position =
      r_e * across(shells.by_increment.row(2).transpose()) -
      moment_by_depth * n;
}

}  // namespace limber::contact
