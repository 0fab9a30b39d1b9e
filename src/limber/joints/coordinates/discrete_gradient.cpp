// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/discrete_gradient.hpp"

#include <cmath>
#include <limits>

namespace limber::joints {
namespace {

// A balance is closed when its remainder is round-off of its terms [-].
constexpr double kRoundoff = 4.0 * std::numeric_limits<double>::epsilon();
// Below this rotation the gradient at the middle is exact to round-off [rad].
constexpr double kSmallRotation = 1e-5;

// The rotation halfway between those of both ends.
Matrix3 find_middle_rotation(const Matrix3& R0, const Matrix3& R1) {
  const Quaternion q0(R0);
  const Quaternion q1(R1);
  const double sign = q0.dot(q1) < 0.0 ? -1.0 : 1.0;
  return Quaternion(q0.coeffs() + sign * q1.coeffs())
      .normalized()
      .toRotationMatrix();
}

}  // namespace

CoordinateStep find_coordinate_step(const AxisCoordinate& coordinate,
                                    const MotionStep& motion, double near,
                                    double h) {
  CoordinateStep step;
  step.z0 = evaluate(coordinate, motion.begin, near).z;
  RelativeMotion middle = motion.mean;
  middle.R_FM = find_middle_rotation(motion.begin.R_FM, motion.end.R_FM);
  const CoordinateValue value = evaluate(coordinate, middle, near);
  step.rate = value.rate;
  step.gradient = value.gradient;
  step.hessian = value.hessian;
  step.z1 = step.z0 + h * step.rate;
  const Vector3& w = motion.mean.w_FM_F;
  const double speed = w.norm();
  if (coordinate.kind == AxisCoordinate::Kind::angle &&
      h * speed > kSmallRotation) {
    step.z1 = evaluate(coordinate, motion.end, near).z;
    step.rate = (step.z1 - step.z0) / h;
    step.gradient.tail<3>() += ((step.rate - value.rate) / (speed * speed)) * w;
  }
  return step;
}

double find_lack(const StepBalance& b) {
  const double lack =
      b.supplied - b.dissipation - b.power - (b.energy1 - b.energy0) / b.h;
  const double noise =
      kRoundoff *
      ((std::abs(b.energy0) + std::abs(b.energy1)) / b.h +
       std::abs(b.dissipation) + std::abs(b.supplied) + std::abs(b.power) +
       std::abs(b.force) * (std::abs(b.z0) + std::abs(b.z1)) / b.h);
  return std::abs(lack) <= noise ? 0.0 : lack;
}

ScalarResponse balance(const ScalarStep& step, const CoordinateStep& coordinate,
                       double h) {
  ScalarResponse response = step.response;
  const double rate = coordinate.rate;
  const double lack = find_lack({.energy0 = step.energy0,
                                 .energy1 = step.energy1,
                                 .h = h,
                                 .dissipation = response.dissipation,
                                 .supplied = response.supplied,
                                 .power = response.force * rate,
                                 .force = response.force,
                                 .z0 = coordinate.z0,
                                 .z1 = coordinate.z1});
  if (lack != 0.0 && rate != 0.0) response.force += lack / rate;
  return response;
}

}  // namespace limber::joints
