// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/app/reports/error_table.hpp"
#include "limber/app/reports/levels.hpp"
#include "limber/app/run/checkpoints.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/run_scenery.hpp"
#include "limber/common/progress.hpp"
#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// Result of one run of a scene.
struct Run {
  scene::Scene scene;
  scene::BuiltScene built;
  results::Scenery scenery;  ///< with the texts of the files at the start
  results::History history;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;  ///< peaks of the probes' columns, and energy
  std::vector<std::string> printed_warnings;  ///< during the run
  std::vector<BodyLevel> levels;     ///< and whether they were justified
  std::optional<ErrorTable> errors;  ///< of its probes, if asked for
  std::exception_ptr failure;        ///< the NumericalError that ended it early
};

/// Builds and simulates a scene, without output. On NumericalError the run
/// contains the results until then, and `failure`.
/// @param cache empty for the default one
/// @param judges whether to find `levels`, which costs time at every step
[[nodiscard]] Run simulate_scene(const scene::Scene& scene,
                                 const scene::Reducer& reducer,
                                 const std::filesystem::path& cache,
                                 const Progress& progress,
                                 const CheckpointPlan& checkpoints = {},
                                 bool judges = false);

/// The same for a scene that is already built, with its pictures.
[[nodiscard]] Run simulate_pictured(const scene::Scene& scene,
                                    PicturedScene made,
                                    const std::filesystem::path& cache,
                                    const Progress& progress,
                                    const CheckpointPlan& checkpoints = {},
                                    bool judges = false);

/// The same without its pictures.
[[nodiscard]] Run simulate_built(const scene::Scene& scene,
                                 scene::BuiltScene built,
                                 const std::filesystem::path& cache,
                                 const Progress& progress,
                                 const CheckpointPlan& checkpoints = {},
                                 bool judges = false);

/// Progress shown by `bar`, that ends a run between two steps after a signal.
[[nodiscard]] Progress watch_signals(const Progress& bar);

/// The same as simulate_scene with a progress bar, warnings and the judgement
/// of levels.
[[nodiscard]] Run run_scene(const scene::Scene& scene,
                            const std::filesystem::path& cache,
                            const CheckpointPlan& checkpoints = {});

/// Wall time of simulating the run again, outputs included [s].
[[nodiscard]] double repeat_timing(const Run& run, const Progress& progress);

/// Summary of the run: steps, times, energy, probes (name -> final, peak,
/// peak_time).
[[nodiscard]] Json summarize(const Run& run);

/// Prints the run's summary, as JSON or as text, and only then draws its
/// pictures, which may take longer than the run.
/// @param folder where its files are
/// @throws NumericalError if the run ended early, after drawing its pictures;
/// Interrupted with the way to continue.
void finish_run(const Run& run, const OutputFolder& folder, bool json);

/// Writes results.h5, probes.csv, summary.json and other files that the
/// scenario requests, except pictures.
void write_run(const Run& run, const std::filesystem::path& folder, bool xdmf);

/// Whether the scenario requests pictures, and there is something to draw.
[[nodiscard]] bool has_pictures(const Run& run);

/// Draws them. A picture that fails gives a warning, and the run is kept.
void draw_run(const Run& run, const std::filesystem::path& folder);

}  // namespace limber::app
