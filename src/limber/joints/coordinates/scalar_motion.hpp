// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::joints {

/// A coordinate z of a coupler (an angle, a distance or a path's length) and
/// its rate.
struct ScalarMotion {
  double z = 0.0;     ///< [rad or m]
  double rate = 0.0;  ///< [rad/s or m/s]
};

/// Response of a scalar law.
///
/// Equation   supplied = d energy / dt + dissipation + force rate
struct ScalarResponse {
  double force = 0.0;        ///< positive in the direction of z [N or N m]
  double energy = 0.0;       ///< [J]
  double dissipation = 0.0;  ///< >= 0 [W]
  double supplied = 0.0;     ///< power supplied by a drive [W]
  double stiffness = 0.0;    ///< -d force / d z [N/m or N m/rad]
  double damping = 0.0;      ///< -d force / d rate [N s/m or N m s/rad]

  ScalarResponse& operator+=(const ScalarResponse& other) {
    force += other.force;
    energy += other.energy;
    dissipation += other.dissipation;
    supplied += other.supplied;
    stiffness += other.stiffness;
    damping += other.damping;
    return *this;
  }
};

/// A coordinate of a coupler as it is recorded, and the sum of the responses
/// along it.
struct CoordinateReading {
  ScalarMotion motion = {};
  ScalarResponse response = {};
  /// The response's force; for a spring between two points, its tension [N or
  /// N m].
  double effort = 0.0;
};

}  // namespace limber::joints
