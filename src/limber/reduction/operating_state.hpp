// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Validity of linear theory. It neglects H^T H / 2 of the Green strain: a
/// fraction kLimit of the linear part where the displacement gradient H is 2
/// kLimit.
struct LinearTrust {
  static constexpr double kLimit = 0.1;  ///< of each value below [-, rad]

  double displacement = 0.0;  ///< largest, over the mesh's longest edge [-]
  double strain = 0.0;        ///< largest principal strain [-]
  double rotation = 0.0;      ///< largest against the body frame [rad]

  [[nodiscard]] bool is_linear() const {
    return displacement <= kLimit && strain <= kLimit && rotation <= kLimit;
  }
};
/// One sentence with the three values and the limit.
[[nodiscard]] std::string describe(const LinearTrust& trust);

/// Deformation and the corresponding steady motion, mesh frame.
struct OperatingState {
  Matrix3X u;               ///< 3 x N, no rigid motion if the body is free [m]
  Matrix3X internal_force;  ///< K u, 3 x N; zero where clamped [N]
  double strain_energy = 0.0;  ///< [J]
  LinearTrust trust;

  Vector3 acceleration = Vector3::Zero();          ///< of the c.m. [m/s^2]
  Vector3 angular_acceleration = Vector3::Zero();  ///< [rad/s^2]
  Vector3 velocity = Vector3::Zero();              ///< of a drift [m/s]
  Vector3 angular_velocity = Vector3::Zero();      ///< [rad/s]
  std::optional<double> critical_speed;            ///< about its axis [rad/s]
  /// Reaction of the clamp; for a free body, the missing load for the motion to
  /// persist, distributed over the body as M times a rigid acceleration.
  Vector3 support_force = Vector3::Zero();  ///< [N]
  Vector3 support_moment =
      Vector3::Zero();  ///< about the undeformed c.m. [N m]
};

}  // namespace limber::flexbody
