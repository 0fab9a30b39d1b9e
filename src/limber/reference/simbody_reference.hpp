// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/simulation/breakpoints.hpp"
#include "limber/reference/joint_model.hpp"
#include "limber/reference/mechanism.hpp"
#include "limber/reference/snapshot.hpp"

/// Simbody, a rigid-body program that shares no code with ours, on the same
/// mechanism (docs/theory/verification.md).
namespace limber::reference {

struct SimbodyOptions {
  JointModel joints = JointModel::bushings;
  /// Of Simbody's error-controlled integrator (Runge-Kutta-Merson) [-].
  double accuracy = 1e-12;
};

struct SimbodyRun {
  std::vector<Snapshot> snapshots;  ///< the start and every output
  long steps = 0;                   ///< count
};

/// "Simbody 3.7.0".
[[nodiscard]] std::string simbody_name();

/// Simulates from time 0 through `marks`, the last of which is the end. No step
/// crosses a mark; at a jump of a load the step before uses the left limit and
/// the step after the right one.
/// @throws NumericalError with Simbody's message if it fails.
[[nodiscard]] SimbodyRun simulate(
    const Mechanism& mechanism, const SimbodyOptions& options,
    const std::vector<dynamics::Breakpoint>& marks,
    const Progress& progress = {});

}  // namespace limber::reference
