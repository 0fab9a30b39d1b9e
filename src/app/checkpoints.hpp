// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "dynamics/simulation.hpp"
#include "results/history.hpp"
#include "scene/scene.hpp"

namespace limber::app {

/// Whether and where a run leaves checkpoints, and whether it goes on from one.
struct CheckpointPlan {
  std::filesystem::path file;  ///< empty: none
  double interval = 60.0;      ///< of wall time [s]
  bool resumes = false;
};

/// The plan at work on a run. A checkpoint to go on from is read at once, with
/// the history up to it; without one the run begins anew, with a warning.
/// @param history outlives what is returned
/// @throws InputError if the checkpoint is damaged or of another run.
[[nodiscard]] dynamics::Continuation make_continuation(
    const CheckpointPlan& plan, const scene::BuiltScene& built,
    results::History& history);

/// Of a run that has ended.
void remove_checkpoint(const CheckpointPlan& plan);

}  // namespace limber::app
