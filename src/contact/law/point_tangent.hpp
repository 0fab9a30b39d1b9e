// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/contact/law/bristle_friction.hpp"
#include "limber/contact/law/contact_damping.hpp"

namespace limber::contact {

/// Derivatives of the force on the slave's point, f n + t, with respect to its
/// motion relative to the master's point; unsymmetric during slip.
///
/// Equation   n from master to slave, d = -n . u, d' = -n . v:
///            -dF/du = (n + dt/df) n^T df/dd  - dt/d increment
///            -dF/dv = (n + dt/df) n^T df/dd' - dt/d velocity
/// Limits     n is held
struct PointTangent {
  Matrix3 stiffness = Matrix3::Zero();  ///< -dF/du [N/m]
  Matrix3 damping = Matrix3::Zero();    ///< -dF/dv [N s/m]
};

/// All arguments expressed in one frame.
[[nodiscard]] inline PointTangent find_point_tangent(
    const Vector3& normal, const DampedForce& pressed,
    const BristleResponse& friction) {
  const Vector3 pushed = normal + friction.by_normal_force;
  return {
      pushed * (pressed.stiffness * normal).transpose() - friction.by_increment,
      pushed * (pressed.damping * normal).transpose() - friction.by_velocity};
}

}  // namespace limber::contact
