// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "beam.hpp"

/// The case study as the report times it: from nodal forces to the world
/// displacements of all stored nodes at every step.
namespace limber::bench {

inline constexpr double kCaseEnd = 1.0;      // [s]
inline constexpr double kCaseStep = 8.7e-4;  // [s]

/// 0, 8.7e-4, ..., 1 s.
[[nodiscard]] std::vector<double> list_case_times();

/// Seconds of processor time of the parts of one run.
struct Cost {
  double projection = 0.0;  // forces to modes, model
  double steps = 0.0;
  double displacements = 0.0;
  double wall = 0.0;  // all of them by the wall clock
  [[nodiscard]] double total() const {
    return projection + steps + displacements;
  }
};

/// Runs the case study at level `uncoupled` and writes displacements into `u`,
/// 3n x T [m].
Cost run_case(const Body& body, const StepForces& strike,
              dynamics::IntegratorKind integrator, MatrixX& u);

struct Statistics {
  double mean = 0.0;
  double deviation = 0.0;  // standard, of the groups' means
};

/// As the report's %%timeit: the mean and standard deviation of 7 groups of 20
/// calls, each call telling its own seconds. Several things are called in turn,
/// so that what else the machine does falls on all of them.
[[nodiscard]] std::vector<Statistics> time_in_turn(
    const std::vector<std::function<double()>>& calls);
[[nodiscard]] inline Statistics time_repeatedly(
    const std::function<double()>& call) {
  return time_in_turn({call})[0];
}

/// Seconds to fill `u` with a number: a lower bound for any program that stores
/// this result in memory.
[[nodiscard]] double time_filling(MatrixX& u);
/// The same into `bytes` that the system has just handed out.
[[nodiscard]] double time_filling_fresh(std::size_t bytes);

/// Processor time of this thread [s]: what else runs on the machine does not
/// count.
[[nodiscard]] double read_clock();

}  // namespace limber::bench
