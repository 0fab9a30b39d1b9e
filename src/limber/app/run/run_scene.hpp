// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/json.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/common/progress.hpp"
#include "limber/runs/run.hpp"

namespace limber::app {

/// Progress shown by `bar`, that ends a run between two steps after a signal.
[[nodiscard]] Progress watch_signals(const Progress& bar);

/// runs::simulate_scene with a progress bar, warnings and the judgement of
/// levels.
/// @param signals deferred from when steps begin; null: none
[[nodiscard]] runs::Run run_scene(const scene::Scene& scene,
                                  const std::filesystem::path& cache,
                                  const runs::CheckpointPlan& checkpoints = {},
                                  DeferredSignals* signals = nullptr);

/// Summary of the run: steps, times, energy, probes (name -> final, peak,
/// peak_time).
[[nodiscard]] Json summarize(const runs::Run& run);

/// Prints the run's summary, as JSON or as text, and only then draws its
/// pictures, which may take longer than the run.
/// @param folder where its files are
/// @throws NumericalError if the run ended early, after drawing its pictures;
/// Interrupted with the way to continue.
void finish_run(const runs::Run& run, const OutputFolder& folder, bool json);

/// Writes results.h5, probes.csv, summary.json and other files that the
/// scenario requests, except pictures.
void write_run(const runs::Run& run, const std::filesystem::path& folder,
               bool xdmf);

/// Whether the scenario requests pictures, and there is something to draw.
[[nodiscard]] bool has_pictures(const runs::Run& run);

/// Draws them. A picture that fails gives a warning, and the run is kept.
void draw_run(const runs::Run& run, const std::filesystem::path& folder);

}  // namespace limber::app
