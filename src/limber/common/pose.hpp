// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber {

/// Pose X_AB of frame B in frame A: a point b (in B) is at p + R b (in A).
struct Pose {
  Matrix3 R = Matrix3::Identity();  ///< rotation R_AB [-]
  Vector3 p = Vector3::Zero();      ///< position p_AB [m], in A

  [[nodiscard]] Pose inverse() const {
    return {R.transpose(), -(R.transpose() * p)};
  }
  /// X_AC = X_AB * X_BC.
  [[nodiscard]] Pose operator*(const Pose& other) const {
    return {R * other.R, p + R * other.p};
  }
  [[nodiscard]] Vector3 operator*(const Vector3& point) const {
    return p + R * point;
  }
};

}  // namespace limber
