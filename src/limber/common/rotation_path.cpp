// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/rotation_path.hpp"

#include <limits>

#include "limber/common/rotation.hpp"

namespace limber {
namespace {

// Largest difference of a rotation from that of the mean angular velocity
// [rad].
constexpr double kSameRotation = 1.0;

}  // namespace

Vector3 integrate_rotation(const Matrix3& R, const Vector3& w_0,
                           const Vector3& w_1, double h, RotationAxes axes) {
  const Vector3 theta = log_rotation(R);
  if (!((theta - 0.5 * h * (w_0 + w_1)).norm() <= kSameRotation)) {
    return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const double sign = axes == RotationAxes::fixed ? 1.0 : -1.0;
  return theta + (sign * h * h / 12.0) * w_0.cross(w_1);
}

}  // namespace limber
