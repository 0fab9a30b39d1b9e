// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limber::dynamics {

/// What one step cost and did.
struct StepResult {
  int iterations = 0;  ///< Newton's, 0 for explicit schemes
  int factorizations = 0;
  double load_work = 0.0;   ///< of loads, gravity and drives [J]
  double dissipated = 0.0;  ///< by couplers and modes over the step [J]
};

}  // namespace limber::dynamics
