// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "judge.hpp"

namespace limber::bench {

/// What a long run has lost, by the number of its steps.
struct Duration {
  dynamics::IntegratorKind integrator =
      dynamics::IntegratorKind::generalized_alpha;
  std::vector<double> steps;
  std::vector<double> energy;    ///< left open, of what passed through [-]
  std::vector<double> momentum;  ///< angular, changed, of itself [-]
  Verdict verdict;
};

/// Two beams on a hinge, turning free, as steps of 10 us.
[[nodiscard]] Cell make_long_cell(dynamics::IntegratorKind integrator);

/// For a separate process; read_duration reads the result.
[[nodiscard]] std::string run_long(const Cell& cell, const Beams& beams,
                                   double steps);
[[nodiscard]] Duration read_duration(const Cell& cell, const Ending& ending);

}  // namespace limber::bench
