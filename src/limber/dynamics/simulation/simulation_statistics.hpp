// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/records/archive.hpp"
#include "limber/dynamics/monitors/event.hpp"

namespace limber::dynamics {

/// Cost, events and warnings of a run.
struct SimulationStatistics {
  long steps = 0;           ///< count
  long rejected_steps = 0;  ///< count, with a tolerance
  long halved_steps = 0;    ///< count of steps that failed in full length
  int passes = 0;           ///< count of passes over the whole time
  /// With a tolerance: estimated largest error of any point's position [m].
  double estimated_error = 0.0;
  long newton_iterations = 0;  ///< count
  long factorizations = 0;     ///< count
  long linear_solves = 0;      ///< count, of implicit schemes and failed steps
  int exact_modes = 0;         ///< number of modes solved in closed form
  double stable_step = 0.0;    ///< of central differences; 0: not computed [s]
  double seconds = 0.0;        ///< wall time of the stepping [s]
  std::vector<Event> events;   ///< in the order of time
  std::vector<std::string> warnings;
};

/// Saves or restores the counts that add up over a run.
inline void exchange_costs(Archive& archive, SimulationStatistics& statistics) {
  archive(statistics.steps, statistics.rejected_steps, statistics.halved_steps,
          statistics.newton_iterations, statistics.factorizations,
          statistics.linear_solves);
}

}  // namespace limber::dynamics
