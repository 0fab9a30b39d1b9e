// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "limber/dynamics/analysis/small_motion.hpp"

namespace limber::dynamics {

/// One input of a linearised system.
struct LinearInput {
  std::string name;
  std::string unit;
  double value = 0.0;  ///< at the reference [unit]
  VectorX force;       ///< on x of SmallMotion, by the input [row's / unit]
  /// Of couplers and transmissions, rows as SmallMotion::G, at rest of all else
  /// [N, N m / unit].
  VectorX wrenches;
  int written = -1;  ///< index of the controllers' input that it is; else -1
};

/// A drive of a system that commands itself.
struct DriveSource {
  int coupler = -1;  ///< index of its coupler, or
  int transmission = -1;
  int number = 0;  ///< among the drives there, from 0
};

/// Names of drives, which a model does not have.
using DriveNames = std::function<std::string(const DriveSource&)>;

/// What acts from outside on the system: its loads, by their factor; the
/// commands of its drives; the inputs that its controllers write, which loads
/// and drives follow. A command with a damper to its rate has that rate as an
/// input of its own, NAME.rate. Equal names get what they are of in front:
/// "load.NAME".
///
/// Equation   force = d (generalised force) / d input, the state unchanged
/// Limits     nodal forces (SystemModel::body_loads) act as they are, and are
///            no inputs
/// @param motion of the same model and state, in axes with R = 1
/// @param names by default those of couplers and transmissions, ".2" after the
/// second of one
[[nodiscard]] std::vector<LinearInput> find_linear_inputs(
    const SystemModel& model, const SystemState& state,
    const SmallMotion& motion, const DriveNames& names = {});

}  // namespace limber::dynamics
