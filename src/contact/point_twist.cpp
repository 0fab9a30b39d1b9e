// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/point_twist.hpp"

#include <algorithm>
#include <cmath>

#include "limber/contact/law/bristle_friction.hpp"

namespace limber::contact {
namespace {

// Rotation of B relative to A since then, about the normal [rad].
double find_increment(const joints::PairBodies& bodies, const Vector3& normal_W,
                      const TurnMemory& former) {
  if (!former.is_set()) return 0.0;
  const TurnMemory now = find_turn(bodies);
  const Quaternion turn =
      now.quat_AB() * former.quat_AB().conjugate();  // in A's frame
  const Vector3 normal_A = bodies.A.R_WB.transpose() * normal_W;
  const double sine = turn.vec().norm();
  if (sine == 0.0) return 0.0;
  const double sign = turn.w() < 0.0 ? -1.0 : 1.0;
  const double angle = 2.0 * std::atan2(sine, sign * turn.w());
  return sign * angle / sine * normal_A.dot(turn.vec());
}

}  // namespace

PointTwist::PointTwist(const ContactParameters& parameters,
                       const PairModuli& moduli, double mass, double size)
    : friction_(parameters.friction),
      moduli_(moduli),
      radius_(parameters.radius),
      mass_(mass),
      size_(size) {}

double PointTwist::find_arm(const PointMemory& memory) const {
  return memory.tangential_stiffness / (8.0 * moduli_.tangential);
}

TwistResponse PointTwist::evaluate(const joints::PairBodies& bodies,
                                   const Point& point) const {
  const double a = find_arm(point.memory);
  const double k_r = 16.0 / 3.0 * a * a * a * moduli_.torsional;
  const Vector3 w_W =
      bodies.B.R_WB * bodies.B.w_WB_B - bodies.A.R_WB * bodies.A.w_WB_B;
  const double spin = point.meeting.normal_W.dot(w_W);
  const double radius =
      radius_.value_or(1.0 / std::max(point.meeting.curvature, 1.0 / size_));
  const double load_radius =
      std::cbrt(0.75 * point.normal_force * radius / moduli_.normal);
  const TorsionalFriction law(
      {.friction =
           find_coefficient(friction_, std::abs(spin) * load_radius).value,
       .stiffness = k_r,
       .damping = find_bristle_damping(k_r, 0.4 * mass_ * radius * radius)});
  return law.evaluate({point.memory.twist},
                      {.increment = find_increment(
                           bodies, point.meeting.normal_W, point.memory.turn),
                       .velocity = spin,
                       .normal_force = point.normal_force,
                       .contact_radius = load_radius});
}

TurnMemory find_turn(const joints::PairBodies& bodies) {
  const Quaternion quat(Matrix3(bodies.A.R_WB.transpose() * bodies.B.R_WB));
  return {quat.w(), quat.x(), quat.y(), quat.z()};
}

void add_couple(const TwistResponse& twist, const Vector3& normal_W, double arm,
                double h, std::size_t first, joints::PairResponse& out) {
  const Vector3 along = normal_W.cross(normal_W.unitOrthogonal());
  // Stiffness of a force against the difference of both points' motion along
  // it; the tangent neglects the damper.
  const Matrix3 K =
      twist.by_increment / (4.0 * arm * arm) * along * along.transpose();
  for (const std::size_t i : {first, first + 1}) {
    joints::PairPoint& point = out.points()[i];
    const double side = i == first ? 1.0 : -1.0;
    point.force_W = side * twist.moment / (2.0 * arm) * along;
    point.stiffness = -K;
    out.coupling(i, i == first ? first + 1 : first) = K;
  }
  out.energy += twist.energy;
  out.dissipation += twist.damper_power + (h > 0.0 ? twist.slip_work / h : 0.0);
}

}  // namespace limber::contact
