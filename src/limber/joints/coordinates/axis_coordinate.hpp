// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/records/fields.hpp"
#include "limber/joints/coordinates/motion.hpp"

namespace limber::joints {

/// A coordinate of M relative to F along or about an axis.
///
/// Equation   distance: z = e . p_FM. Angle: of the rotation about e that is
///            nearest to R_FM, z = 2 atan2(e . q_v, q_0) of its quaternion, to
///            which any whole turns are added. With R = Rot(a, s) Rot(b, t),
///            a and b normal to each other, it is s about a and t about b.
/// Source     swing-twist decomposition [@dobrowolski2015]
/// Limits     an angle is undefined where e is reversed; its whole turns are
///            correct while it is less than pi from `near`.
struct AxisCoordinate {
  enum class Kind { angle, distance };
  Kind kind = Kind::angle;
  Vector3 axis = Vector3::UnitZ();  ///< unit, in F (and in M if R_FM = I) [-]
};

/// Value and derivatives of a coordinate, with respect to the increments
/// (dp_FM_F, dphi_F) of CouplerResponse.
struct CoordinateValue {
  double z = 0.0;                      ///< [rad] or [m]
  double rate = 0.0;                   ///< [rad/s] or [m/s]
  Vector6 gradient = Vector6::Zero();  ///< of z [-]
  /// Derivative of the rotation part of an angle's gradient [1/rad].
  Matrix3 hessian = Matrix3::Zero();
};

/// @param near whole turns are added to an angle to bring it nearest to this
/// [rad]
/// @throws NumericalError where the axis is reversed.
[[nodiscard]] CoordinateValue evaluate(const AxisCoordinate& coordinate,
                                       const RelativeMotion& motion,
                                       double near);

/// z alone [rad] or [m]. Does not throw: its value is arbitrary where the axis
/// is reversed.
[[nodiscard]] double find_position(const AxisCoordinate& coordinate,
                                   const RelativeMotion& motion, double near);

constexpr auto fields_of(const AxisCoordinate*) {
  return list_fields("coordinate", "kind", "axis");
}

}  // namespace limber::joints
