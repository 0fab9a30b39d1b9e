// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/roll_pitch_yaw.hpp"

#include <Eigen/Geometry>

namespace limber {

Matrix3 rotation_rpy(const Vector3& rpy) {
  return (Eigen::AngleAxisd(rpy.z(), Vector3::UnitZ()) *
          Eigen::AngleAxisd(rpy.y(), Vector3::UnitY()) *
          Eigen::AngleAxisd(rpy.x(), Vector3::UnitX()))
      .toRotationMatrix();
}

}  // namespace limber
