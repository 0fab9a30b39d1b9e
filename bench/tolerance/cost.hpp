// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "runs.hpp"

namespace limber::bench::tolerance {

/// Fixed steps that err as much as a run to a tolerance.
struct Rival {
  Rung rung;
  /// Of the tolerance's time of the processor, medians of interleaved runs [-].
  double times_dearer = 0.0;
  /// Already the longest steps that outputs leave err less: the run to a
  /// tolerance could be as coarse and could not be beaten further.
  bool is_coarsest = false;
};

/// @returns nothing if no step of the ladder errs as little.
[[nodiscard]] std::optional<Rival> find_rival(const SceneRuns& runs,
                                              const Reference& reference,
                                              double tolerance, double error,
                                              bool in_own_steps);

}  // namespace limber::bench::tolerance
