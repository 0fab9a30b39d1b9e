// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"
#include "limber/runs/checkpoints.hpp"
#include "limber/runs/error_table.hpp"
#include "limber/runs/level_judgement.hpp"
#include "limber/runs/pictured_scene.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

/// A scene run as a library: from what scene::load_scene returns to histories
/// of its probes and states.
namespace limber::runs {

/// How a scene is run. All members are optional except for those that bodies
/// need.
struct RunOptions {
  Reductions reductions{};  ///< none needed for rigid scenes
  /// Ends the run between two steps by throwing dynamics::Interrupted.
  Progress progress{};
  CheckpointPlan checkpoints{};
  bool judges_levels = false;      ///< whether to find Run::levels; costs time
  Warn warn{};                     ///< of what goes wrong while steps are taken
  std::function<void()> starts{};  ///< called when all is read, before steps
};

/// Result of one run of a scene.
struct Run {
  scene::Scene scene;
  scene::BuiltScene built;
  results::Scenery scenery;  ///< with the texts of the files at the start
  results::History history;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;  ///< peaks of the probes' columns, and energy
  std::vector<std::string> given_warnings;  ///< to RunOptions::warn
  std::vector<BodyLevel> levels;            ///< and whether they were justified
  std::optional<ErrorTable> errors;         ///< of its probes, if found
  std::exception_ptr failure;  ///< the NumericalError that ended it early
};

/// Builds and simulates a scene. A NumericalError ends the run early: it
/// contains the results until then, and `failure`.
/// @throws InputError for what cannot be built or checked before the run.
[[nodiscard]] Run simulate_scene(const scene::Scene& scene,
                                 const RunOptions& options);

/// The same for a scene that is already built, with its pictures.
[[nodiscard]] Run simulate_pictured(const scene::Scene& scene,
                                    PicturedScene made,
                                    const RunOptions& options);

/// The same without its pictures.
[[nodiscard]] Run simulate_built(const scene::Scene& scene,
                                 scene::BuiltScene built,
                                 const RunOptions& options);

/// Wall time of simulating the run again, outputs included [s].
[[nodiscard]] double repeat_timing(const Run& run, const Progress& progress);

}  // namespace limber::runs
