// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <filesystem>

#include "app/checkpoints.hpp"
#include "app/json.hpp"
#include "app/levels.hpp"
#include "common/progress.hpp"
#include "dynamics/run_record.hpp"
#include "results/history.hpp"
#include "scene/scene.hpp"

namespace limber::app {

/// What one run of a scene gives.
struct Run {
  scene::Scene scene;
  scene::BuiltScene built;
  results::History history;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;     ///< peaks of the probes' columns, and energy
  std::vector<std::string> told;  ///< warnings that were printed as they came
  std::vector<BodyLevel> levels;  ///< whether each body's was justified
  std::exception_ptr failure;     ///< the NumericalError that ended it early
};

/// Builds and simulates a scene, without a word. On NumericalError the run
/// holds what was computed until then, and `failure`.
/// @param cache empty for the default one
/// @param judges whether it finds `levels`, which costs time at every step
[[nodiscard]] Run simulate_scene(const scene::Scene& scene,
                                 const scene::Reducer& reducer,
                                 const std::filesystem::path& cache,
                                 const Progress& progress,
                                 const CheckpointPlan& checkpoints = {},
                                 bool judges = false);

/// The same with a progress bar, warnings and the judgement of levels.
[[nodiscard]] Run run_scene(const scene::Scene& scene,
                            const std::filesystem::path& cache,
                            const CheckpointPlan& checkpoints = {});

/// Wall time that simulating the run once more takes, outputs included [s].
[[nodiscard]] double time_again(const Run& run, const Progress& progress);

/// The run in figures: steps, times, energy, probes (name -> final,
/// peak, peak_time).
[[nodiscard]] Json summarize(const Run& run);

/// Prints the run's summary, as JSON or as text.
/// @param folder where its files are
/// @throws NumericalError if the run ended early; Interrupted says how to go
/// on.
void finish_run(const Run& run, const std::filesystem::path& folder, bool json);

/// Writes results.h5, probes.csv, summary.json and what the scenario asks for.
void write_run(const Run& run, const std::filesystem::path& folder, bool xdmf);

}  // namespace limber::app
