// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limber/common/records/manifest.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/results/history.hpp"

namespace limber::runs {

/// Whether and where a run writes checkpoints, and whether it continues from
/// one.
struct CheckpointPlan {
  std::filesystem::path file;  ///< empty: none
  double interval = 60.0;      ///< of wall time [s]
  bool resumes = false;
};

/// Receives a warning during a run, at once.
using Warn = std::function<void(const std::string&)>;

/// Applies the plan to a run. A checkpoint to continue from is read at once,
/// with the history up to it; without one the run starts from the beginning,
/// which is a warning. Failure to write a checkpoint gives one warning, and the
/// run continues.
/// @param describe makes the run's manifest, when it is needed
/// @param history must outlive the result
/// @param warn may be empty; must outlive the result, as `warnings`, to which
/// what it was given during the run is added
/// @throws InputError if the checkpoint is damaged or of another run, naming
/// the differences.
[[nodiscard]] dynamics::Continuation make_continuation(
    const CheckpointPlan& plan, const std::function<Manifest()>& describe,
    results::History& history, const Warn& warn,
    std::vector<std::string>& warnings);

}  // namespace limber::runs
