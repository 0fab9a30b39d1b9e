// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/analysis/small_motion.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

/// Whether a system is in steady state at its start: at rest, or in steady
/// rotation.
namespace limber::dynamics {

/// Additional load that would make a start steady: at rest, or rotating with
/// the axes; of the linked group that is farthest from it, measured by its own
/// forces.
struct Imbalance {
  double force = 0.0;   ///< the largest on a body [N]
  double moment = 0.0;  ///< the largest on a body [N m]
  double acting = 0.0;  ///< sum of its forces, including centripetal ones [N]
  std::string force_body;
  std::string moment_body;
  /// Whether it exceeds round-off of the acting forces.
  bool matters = false;
};

[[nodiscard]] bool moves(const SystemState& state);
[[nodiscard]] bool moves(const SystemModel& model, const SystemState& state,
                         const std::vector<BodyIndex>& bodies);

/// Equation   left = m (a - w x (v - v_0)),  J (w_b' - w x w_b) of each body,
///            w that of the axes, v_0 as find_drifts; for modes
///            sqrt(m) |eta''|
/// @param spins of each body's axes, world frame [rad/s]
[[nodiscard]] Imbalance find_imbalance(const SystemModel& model,
                                       const SystemState& state,
                                       const std::vector<Vector3>& spins);

/// The state after a time [s], if it is steady in the rotating axes.
[[nodiscard]] SystemState advance_steadily(const SystemModel& model,
                                           const SystemState& state,
                                           const TurningAxes& axes,
                                           double time);

/// The largest angular velocity of a body, world frame [rad/s].
[[nodiscard]] Vector3 find_fastest_spin(const SystemState& state,
                                        const std::vector<BodyIndex>& bodies);
[[nodiscard]] Vector3 find_fastest_spin(const SystemState& state);

}  // namespace limber::dynamics
