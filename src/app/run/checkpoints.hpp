// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/interruption.hpp"
#include "common/manifest.hpp"
#include "dynamics/simulation.hpp"
#include "results/history.hpp"

namespace limber::app {

/// Whether and where a run leaves checkpoints, and whether it goes on from one.
struct CheckpointPlan {
  std::filesystem::path file;  ///< empty: none
  double interval = 60.0;      ///< of wall time [s]
  bool resumes = false;
  DeferredSignals* signals = nullptr;  ///< deferred from when steps begin
};

/// The plan at work on a run. A checkpoint to go on from is read at once, with
/// the history up to it; without one the run begins anew, with a warning. A
/// checkpoint that cannot be written is a warning, once, and the run goes on.
/// From then on `plan.signals` ends the run between two steps.
/// @param describe makes the run's manifest, when it is needed
/// @param history outlives what is returned
/// @param warnings likewise; what was printed as it came is added
/// @throws InputError if the checkpoint is damaged or of another run, naming
/// what has changed.
[[nodiscard]] dynamics::Continuation make_continuation(
    const CheckpointPlan& plan, const std::function<Manifest()>& describe,
    results::History& history, std::vector<std::string>& warnings);

}  // namespace limber::app
