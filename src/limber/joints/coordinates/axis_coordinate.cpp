// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/axis_coordinate.hpp"

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::joints {
namespace {

// Square of the twist part of the quaternion: below this, within 6e-5 rad of
// reversal, the twist is undefined [-].
constexpr double kReversed = 1e-9;

double add_turns(double angle, double near) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return angle + kTurn * std::round((near - angle) / kTurn);
}

}  // namespace

CoordinateValue evaluate(const AxisCoordinate& coordinate,
                         const RelativeMotion& motion, double near) {
  const Vector3& e = coordinate.axis;
  CoordinateValue value;
  if (coordinate.kind == AxisCoordinate::Kind::distance) {
    value.z = e.dot(motion.p_FM_F);
    value.rate = e.dot(motion.v_FM_F);
    value.gradient.head<3>() = e;
    return value;
  }
  const Quaternion q(motion.R_FM);
  const double w = q.w();
  const Vector3 v = q.vec();
  const double a = v.dot(e);
  const double size = w * w + a * a;
  if (!(size > kReversed)) {
    throw NumericalError(
        "the axis of a rotation is reversed, where its angle is undefined");
  }
  value.z = add_turns(2.0 * std::atan2(a, w), near);
  // dw = -dphi . v / 2, da = dphi . b / 2; z changes by 2 (w da - a dw) / size.
  const Vector3 b = w * e + v.cross(e);
  const Vector3 g = (w * b + a * v) / size;
  value.gradient.tail<3>() = g;
  value.rate = g.dot(motion.w_FM_F);
  // dv = (w dphi + dphi x v) / 2.
  const Matrix3 dv = 0.5 * (w * Matrix3::Identity() - skew(v));
  const Eigen::RowVector3d dw = -0.5 * v.transpose();
  const Eigen::RowVector3d da = 0.5 * b.transpose();
  const Matrix3 db = e * dw - skew(e) * dv;
  value.hessian =
      (b * dw + w * db + v * da + a * dv - 2.0 * g * (w * dw + a * da)) / size;
  return value;
}

double find_position(const AxisCoordinate& coordinate,
                     const RelativeMotion& motion, double near) {
  const Vector3& e = coordinate.axis;
  if (coordinate.kind == AxisCoordinate::Kind::distance) {
    return e.dot(motion.p_FM_F);
  }
  const Quaternion q(motion.R_FM);
  return add_turns(2.0 * std::atan2(q.vec().dot(e), q.w()), near);
}

}  // namespace limber::joints
