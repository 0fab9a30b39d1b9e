// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace limber::joints {

/// A coordinate z of a coupler: an angle, a distance or a path's length, and
/// its rate.
struct ScalarMotion {
  double z = 0.0;     ///< [rad or m]
  double rate = 0.0;  ///< [rad/s or m/s]
};

/// What a scalar law answers.
///
/// Equation   supplied = d energy / dt + dissipation + force rate
struct ScalarResponse {
  double force = 0.0;        ///< pushes z up [N or N m]
  double energy = 0.0;       ///< [J]
  double dissipation = 0.0;  ///< >= 0 [W]
  double supplied = 0.0;     ///< power that a drive puts in [W]
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

/// Where a switch stands: as the motion has it, or held through a step, so that
/// a law is smooth within one; what it does about it happens between steps.
enum class SwitchMode : unsigned char { by_motion, off, on };

/// Switches that a scalar law has, at most.
inline constexpr int kMaxScalarSwitches = 2;
using SwitchModes = std::array<SwitchMode, kMaxScalarSwitches>;

[[nodiscard]] inline bool is_on(SwitchMode mode, bool by_motion) {
  return mode == SwitchMode::by_motion ? by_motion : mode == SwitchMode::on;
}

/// A function of the motion whose change of sign is an event, in a unit of its
/// own.
struct SwitchValue {
  double value = 0.0;
  double rate = 0.0;  ///< d value / dt
};

}  // namespace limber::joints
