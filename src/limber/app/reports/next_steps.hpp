// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/app/reports/run_summary.hpp"

namespace limber::app {

/// A suggestion, and its reason in the record.
struct NextStep {
  std::string what;
  std::string why;
};

/// At most three, the most useful first; none that the record does not suggest.
[[nodiscard]] std::vector<NextStep> find_next_steps(const RunSummary& run);

/// Total count of a run's steps and parts of steps.
[[nodiscard]] double count_parts(const RunSummary& run);

}  // namespace limber::app
