// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/small_motion.hpp"
#include "dynamics/workspace.hpp"

/// Whether a system goes on as it starts: at rest, or turning steadily.
namespace limber::dynamics {

/// What would have to act besides for a start to be steady: to rest, or to turn
/// on with the axes.
struct Imbalance {
  double force = 0.0;   ///< the largest on a body [N]
  double moment = 0.0;  ///< the largest on a body [N m]
  double acting = 0.0;  ///< sum of forces, those that turn it on too [N]
  std::string force_body;
  std::string moment_body;
  /// Whether it is more than round-off of what acts.
  bool matters = false;
};

[[nodiscard]] bool moves(const SystemState& state);

/// Equation   left = m (a - w x (v - v_0)),  J (w_b' - w x w_b) of each body,
///            w the axes', v_0 that of the mass centre if nothing ties the
///            system to the world, else 0; of modes sqrt(m) |eta''|
[[nodiscard]] Imbalance find_imbalance(const SystemModel& model,
                                       const SystemState& state,
                                       const TurningAxes& axes);

/// The state after a time [s] if it is steady in axes that turn so.
[[nodiscard]] SystemState advance_steadily(const SystemModel& model,
                                           const SystemState& state,
                                           const TurningAxes& axes,
                                           double time);

/// The largest angular velocity of a body, world axes [rad/s].
[[nodiscard]] Vector3 find_fastest_spin(const SystemState& state);

}  // namespace limber::dynamics
