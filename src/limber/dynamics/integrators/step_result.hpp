// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "limber/dynamics/equations/energy_flows.hpp"

namespace limber::dynamics {

/// Powers at one end of a step.
struct StepPower {
  double loads = 0.0;       ///< of loads, gravity and drives [W]
  double dissipated = 0.0;  ///< by couplers and modes [W]
};

/// Of all rows together.
[[nodiscard]] inline StepPower sum(const EnergyFlows& power) {
  return {power.supplied.sum(), power.dissipated.sum()};
}

/// Cost, work and error of one step.
struct StepResult {
  int iterations = 0;       ///< count, of Newton's method; 0 if explicit
  int factorizations = 0;   ///< count
  double load_work = 0.0;   ///< of loads, gravity and drives [J]
  double dissipated = 0.0;  ///< by couplers and modes over the step [J]
  /// Estimated largest error of a point's position by the step [m]; of adaptive
  /// schemes with a tolerance.
  double error = 0.0;
  std::size_t error_body = 0;  ///< index of the body of that point
  StepPower begin;             ///< of the same schemes
  StepPower end;               ///< of the same schemes
};

/// Sets the work and dissipation of a step to sums of its flows.
inline void set_work(const EnergyFlows& flows, StepResult& result) {
  result.load_work = flows.supplied.sum();
  result.dissipated = flows.dissipated.sum();
}

}  // namespace limber::dynamics
