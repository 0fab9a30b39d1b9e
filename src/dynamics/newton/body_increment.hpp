// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

/// A body's part of increments. Its frame is fixed if it is clamped.
struct BodyIncrement {
  BodyIncrement(const BodyModel& body, std::size_t b, const VectorX& x)
      : eta(x.data() + first_row(body, b) + 6) {
    if (!body.has_rigid_motion()) return;
    p = x.segment<3>(first_row(body, b));
    theta = x.segment<3>(first_row(body, b) + 3);
  }
  Vector3 p = Vector3::Zero();      ///< world frame [m]
  Vector3 theta = Vector3::Zero();  ///< body frame [rad]
  const double* eta;                ///< modes [kg^1/2 m]
};

}  // namespace limber::dynamics
