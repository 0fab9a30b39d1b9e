// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/run_scene.hpp"

#include <utility>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/run/unstable_loop.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/runs/unused_cache.hpp"

namespace limber::app {

Progress watch_signals(const Progress& bar) {
  return [bar](std::string_view what, double fraction) {
    const bool is_done = fraction >= 1.0;
    if (find_received_signal() != 0 && !is_done) {
      throw dynamics::Interrupted("interrupted");
    }
    report(bar, what, fraction);
  };
}

runs::Run run_scene(const scene::Scene& scene,
                    const std::filesystem::path& cache,
                    const runs::CheckpointPlan& checkpoints,
                    DeferredSignals* signals) {
  runs::RunOptions options;
  options.progress = watch_signals(make_progress_bar());
  options.reductions = make_reductions(cache, options.progress);
  options.checkpoints = checkpoints;
  options.judges_levels = true;
  options.warn = [](const std::string& text) { print_warnings({text}); };
  options.starts = [signals] {
    if (signals != nullptr) signals->begin();
  };
  runs::PicturedScene made = runs::build_pictured(scene, options.reductions);
  runs::warn_of_unused_cache(cache, made.built);
  clear_progress_bar();
  print_more_notes(scene, made.built.notes);
  print_warnings(made.built.warnings);
  const auto unstable = find_unstable_loop(scene, made.built, options.progress);
  if (unstable) {
    clear_progress_bar();
    print_warnings({*unstable});
  }
  runs::Run run = runs::simulate_pictured(scene, std::move(made), options);
  if (unstable) run.given_warnings.push_back(*unstable);
  clear_progress_bar();
  print_warnings(run.statistics.warnings);
  return run;
}

}  // namespace limber::app
