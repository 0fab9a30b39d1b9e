// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limber/app/console/interruption.hpp"
#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/results/history.hpp"

namespace limber::app {

/// Whether and where a run writes checkpoints, and whether it continues from
/// one.
struct CheckpointPlan {
  std::filesystem::path file;  ///< empty: none
  double interval = 60.0;      ///< of wall time [s]
  bool resumes = false;
  DeferredSignals* signals = nullptr;  ///< deferred from when steps begin
};

/// Applies the plan to a run. A checkpoint to continue from is read at once,
/// with the history up to it; without one the run starts from the beginning,
/// and the terminal says so. Failure to write a checkpoint gives one warning,
/// and the run continues. From then on `plan.signals` ends the run between two
/// steps.
/// @param describe makes the run's manifest, when it is needed
/// @param history must outlive the result
/// @param warnings likewise; warnings already printed are added
/// @throws InputError if the checkpoint is damaged or of another run, naming
/// the differences.
[[nodiscard]] dynamics::Continuation make_continuation(
    const CheckpointPlan& plan, const std::function<Manifest()>& describe,
    results::History& history, std::vector<std::string>& warnings);

}  // namespace limber::app
