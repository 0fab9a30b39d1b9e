// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/bristle_friction.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/contact/law/check_value.hpp"
#include "limber/contact/law/cone_return.hpp"

namespace limber::contact {
namespace {

// Below this 1 + cos(angle) the smallest rotation has no axis.
constexpr double kLeastCosine = 1e-6;

// The bristle rotated from the plane of its normal to that of `normal`, by the
// smallest rotation, which keeps its length.
Vector3 carry(const BristleMemory& memory, const Vector3& normal) {
  const Vector3& before = memory.normal_S;
  const double cosine = 1.0 + before.dot(normal);
  if (before.isZero(0.0) || cosine < kLeastCosine) return Vector3::Zero();
  return memory.s_S - (normal.dot(memory.s_S) / cosine) * (before + normal);
}

}  // namespace

BristleFriction::BristleFriction(const Parameters& parameters)
    : parameters_(parameters) {
  const Parameters& p = parameters;
  check(p.limit);
  check_value(p.stiffness > 0.0, "tangential stiffness [N/m]", p.stiffness,
              "> 0");
  check_value(p.damping >= 0.0, "tangential damping [N s/m]", p.damping,
              ">= 0");
}

BristleResponse BristleFriction::evaluate(const BristleMemory& memory,
                                          const BristleMotion& motion) const {
  const Parameters& p = parameters_;
  const Vector3& normal = motion.normal_S;
  const Matrix3 plane = Matrix3::Identity() - normal * normal.transpose();
  const Vector3 velocity = plane * motion.velocity_S;
  const Vector3 trial = carry(memory, normal) + plane * motion.increment_S;
  const double speed = velocity.norm();
  const FrictionCoefficient mu = find_coefficient(p.limit, speed);
  using Cone = ConeReturn<3>;
  const Cone cone = Cone::find({.trial = trial,
                                .velocity = velocity,
                                .plane = plane,
                                .stiffness = p.stiffness,
                                .damping = p.damping,
                                .limit = mu.value * motion.normal_force});
  BristleResponse response{.force_S = cone.force,
                           .slips = cone.slips,
                           .energy = cone.energy,
                           .slip_work = cone.slip_work,
                           .damper_power = cone.damper_power,
                           .by_increment = cone.by_trial,
                           .by_velocity = cone.by_velocity,
                           .by_normal_force = mu.value * cone.by_limit,
                           .next = {cone.bristle, normal}};
  if (speed > 0.0) {
    response.by_velocity += (motion.normal_force * mu.slope / speed) *
                            cone.by_limit * velocity.transpose();
  }
  return response;
}

double find_bristle_damping(double stiffness, double mass, double share) {
  LIMBER_EXPECT(stiffness >= 0.0);
  LIMBER_EXPECT(mass >= 0.0);
  LIMBER_EXPECT(share >= 0.0);
  return 2.0 * share * std::sqrt(stiffness * mass);
}

}  // namespace limber::contact
