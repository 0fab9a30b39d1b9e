// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/progress.hpp"
#include "dynamics/landmarks.hpp"
#include "dynamics/system_state.hpp"
#include "reference/mechanism.hpp"

/// Simbody, a rigid-body program that shares no code with ours, on the same
/// mechanism (docs/theory/verification.md).
namespace limber::reference {

/// What stands for the joints that are couplers of ours.
enum class JointModel {
  /// Free bodies on force elements with the energy and dissipation of
  /// docs/joints.md, written anew in world axes.
  bushings,
  /// Free bodies on Simbody's own LinearBushing: x-y-z angles in place of the
  /// chordal measure. Equal to first order in the small relative rotation.
  linear_bushings,
  /// Simbody's mobilizers: the limit of infinite stiffness.
  ideal,
};

/// "bushings", "linear-bushings", "ideal".
[[nodiscard]] const std::vector<std::string>& joint_model_names();
/// @throws InputError naming the nearest.
[[nodiscard]] JointModel parse_joint_model(std::string_view name);

/// The watched frames at one time.
struct Snapshot {
  double time = 0.0;                        ///< [s]
  std::vector<dynamics::BodyState> frames;  ///< one a watched frame
  double kinetic = 0.0;                     ///< [J]
  double coupler = 0.0;                     ///< in bushings and springs [J]
};

struct WitnessOptions {
  JointModel joints = JointModel::bushings;
  /// Of Simbody's error-controlled integrator (Runge-Kutta-Merson) [-].
  double accuracy = 1e-12;
};

struct WitnessRun {
  std::vector<Snapshot> snapshots;  ///< the start and every output
  long steps = 0;
};

/// "Simbody 3.7.0".
[[nodiscard]] std::string witness_name();

/// Simulates from time 0 through `marks`, the last of which is the end. No
/// step crosses a mark; where a load jumps the step before takes the left
/// limit and the step after the right one.
/// @throws NumericalError with Simbody's words if it cannot go on.
[[nodiscard]] WitnessRun simulate(const Mechanism& mechanism,
                                  const WitnessOptions& options,
                                  const std::vector<dynamics::Landmark>& marks,
                                  const Progress& progress = {});

}  // namespace limber::reference
