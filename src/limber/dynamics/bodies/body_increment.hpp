// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

/// A body's part of increments. Its frame is fixed if it is clamped.
struct BodyIncrement {
  BodyIncrement(const BodyModel& body, const VectorX& x)
      : eta(x.data() + body.row + 6) {
    if (!body.has_rigid_motion()) return;
    p = translation_rows(body, x);
    theta = rotation_rows(body, x);
  }
  Vector3 p = Vector3::Zero();      ///< world frame [m]
  Vector3 theta = Vector3::Zero();  ///< body frame [rad]
  const double* eta;                ///< modes [kg^1/2 m]
};

}  // namespace limber::dynamics
