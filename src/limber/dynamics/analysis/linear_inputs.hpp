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
  /// Wrenches of couplers and transmissions, rows as SmallMotion::G, all else
  /// at rest [N, N m / unit].
  VectorX wrenches;
  int written = -1;  ///< index of the controllers' input that it is; else -1
};

/// A drive with a command of its own, which follows no input.
struct DriveSource {
  int coupler = -1;  ///< index of its coupler, or
  int transmission = -1;
  int number = 0;  ///< among the drives there, from 0
};

/// Gives names to drives, since a model has none.
using DriveNames = std::function<std::string(const DriveSource&)>;

/// External inputs of the system: the factors of its loads; the commands
/// of its drives; the inputs that its controllers write, which loads and
/// drives follow. If a damper acts on the rate of a command, that rate
/// is a separate input, NAME.rate. Equal names get a prefix:
/// "load.NAME".
///
/// Equation   force = d (generalised force) / d input, the state unchanged
/// Limits     nodal forces (SystemModel::body_loads) act unchanged and are not
///            inputs
/// @param motion of the same model and state, in axes with R = 1
/// @param names by default those of couplers and transmissions, with ".2" for
/// the second drive of one
[[nodiscard]] std::vector<LinearInput> find_linear_inputs(
    const SystemModel& model, const SystemState& state,
    const SmallMotion& motion, const DriveNames& names = {});

}  // namespace limber::dynamics
