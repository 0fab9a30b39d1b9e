// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "joints/motion.hpp"

namespace limber::joints {

/// A coordinate of the motion of M in F along or about an axis.
///
/// Equation   distance: z = e . p_FM. Angle: of the rotation about e that is
///            nearest to R_FM, z = 2 atan2(e . q_v, q_0) of its quaternion, to
///            which any whole turns are added. With R = Rot(a, s) Rot(b, t),
///            a and b normal to each other, it is s about a and t about b.
/// Source     swing-twist decomposition [@dobrowolski2015]
/// Limits     an angle has no meaning where e is turned upside down; its whole
///            turns are right while it is less than pi from `near`.
struct AxisCoordinate {
  enum class Kind { angle, distance };
  Kind kind = Kind::angle;
  Vector3 axis = Vector3::UnitZ();  ///< unit, in F (and, at rest, in M)
};

/// Derivatives are by the increments (dp_FM_F, dphi_F) of CouplerResponse.
struct CoordinateValue {
  double z = 0.0;                      ///< [rad] or [m]
  double rate = 0.0;                   ///< [rad/s] or [m/s]
  Vector6 gradient = Vector6::Zero();  ///< of z
  /// Of an angle's gradient: change of its rotation part.
  Matrix3 hessian = Matrix3::Zero();
};

/// @param near angles are given the whole turns that bring them nearest to
/// this [rad]
/// @throws NumericalError where the axis is turned upside down.
[[nodiscard]] CoordinateValue evaluate(const AxisCoordinate& coordinate,
                                       const RelativeMotion& motion,
                                       double near);

/// z alone. Does not throw: upside down it is any number.
[[nodiscard]] double find_position(const AxisCoordinate& coordinate,
                                   const RelativeMotion& motion, double near);

}  // namespace limber::joints
