// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/analysis/small_motion.hpp"
#include "limber/dynamics/equations/workspace.hpp"

/// Whether a system is in steady state at its start: at rest, or in steady
/// rotation.
namespace limber::dynamics {

/// Additional load that would make a start steady: at rest, or rotating with
/// the axes.
struct Imbalance {
  double force = 0.0;   ///< the largest on a body [N]
  double moment = 0.0;  ///< the largest on a body [N m]
  double acting = 0.0;  ///< sum of forces, including centripetal ones [N]
  std::string force_body;
  std::string moment_body;
  /// Whether it exceeds round-off of the acting forces.
  bool matters = false;
};

[[nodiscard]] bool moves(const SystemState& state);

/// Velocity of the mass centre of a system that nothing ties to the world; else
/// 0 [m/s].
[[nodiscard]] Vector3 find_drift(const SystemModel& model,
                                 const SystemState& state);

/// Equation   left = m (a - w x (v - v_0)),  J (w_b' - w x w_b) of each body,
///            w that of the axes, v_0 that of the mass centre if nothing ties
///            the system to the world, else 0; for modes sqrt(m) |eta''|
[[nodiscard]] Imbalance find_imbalance(const SystemModel& model,
                                       const SystemState& state,
                                       const TurningAxes& axes);

/// The state after a time [s], if it is steady in the rotating axes.
[[nodiscard]] SystemState advance_steadily(const SystemModel& model,
                                           const SystemState& state,
                                           const TurningAxes& axes,
                                           double time);

/// The largest angular velocity of a body, world frame [rad/s].
[[nodiscard]] Vector3 find_fastest_spin(const SystemState& state);

}  // namespace limber::dynamics
