// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace limber::dynamics {

/// Work per time at one end of a step.
struct StepPower {
  double loads = 0.0;       ///< of loads, gravity and drives [W]
  double dissipated = 0.0;  ///< by couplers and modes [W]
};

/// What one step cost and did.
struct StepResult {
  int iterations = 0;  ///< Newton's, 0 for explicit schemes
  int factorizations = 0;
  double load_work = 0.0;   ///< of loads, gravity and drives [J]
  double dissipated = 0.0;  ///< by couplers and modes over the step [J]
  /// Of schemes that estimate their error, if they are asked to: how far the
  /// step put a point wrong, at most, and on which body [m].
  double error = 0.0;
  std::size_t error_body = 0;
  StepPower begin;  ///< of the same schemes
  StepPower end;
};

}  // namespace limber::dynamics
