// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/run_scene.hpp"

#include <algorithm>
#include <utility>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/unused_cache.hpp"
#include "limber/app/reports/cut_contacts.hpp"
#include "limber/app/run/probe_columns.hpp"
#include "limber/app/run/run_manifest.hpp"
#include "limber/app/run/unstable_loop.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/dynamics/simulation/tolerance_loop.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/probes/followed_probes.hpp"

namespace limber::app {
namespace {

void observe(const scene::BuiltScene& built, const dynamics::SystemState& state,
             const dynamics::EnergyBalance& energy, results::History& history) {
  history.times.push_back(state.t);
  history.probe_rows.push_back(
      scene::evaluate_all(built.probes, built.model, state));
  history.states.push_back(state);
  history.energies.push_back(energy);
}

void simulate(const scene::BuiltScene& built, const Progress& progress,
              results::History& history,
              dynamics::SimulationStatistics& statistics,
              dynamics::RunRecord& record,
              const dynamics::Continuation& continuation,
              const dynamics::Followed& followed) {
  dynamics::SystemState state = built.initial;
  const auto observer = [&](const dynamics::SystemState& now,
                            const dynamics::EnergyBalance& energy) {
    observe(built, now, energy, history);
  };
  dynamics::simulate(built.model, state, built.settings, observer, progress,
                     statistics, continuation, followed, record);
}

void include_outputs(const results::History& history, Envelopes& envelopes) {
  for (std::size_t i = 0; i < history.times.size(); ++i) {
    for (std::size_t c = 0; c < history.probe_rows[i].size(); ++c) {
      include(envelopes, c, history.probe_rows[i][c], history.times[i]);
    }
  }
}

}  // namespace

Progress watch_signals(const Progress& bar) {
  return [bar](std::string_view what, double fraction) {
    const bool is_done = fraction >= 1.0;
    if (find_received_signal() != 0 && !is_done) {
      throw dynamics::Interrupted("interrupted");
    }
    report(bar, what, fraction);
  };
}

Run simulate_scene(const scene::Scene& scene, const scene::Reducer& reducer,
                   const std::filesystem::path& cache, const Progress& progress,
                   const CheckpointPlan& checkpoints, bool judges) {
  PicturedScene made =
      build_pictured(scene, reducer, cache, make_full_maker(progress));
  warn_of_unused_cache(cache, made.built);
  return simulate_pictured(scene, std::move(made), cache, progress, checkpoints,
                           judges);
}

Run simulate_pictured(const scene::Scene& scene, PicturedScene made,
                      const std::filesystem::path& cache,
                      const Progress& progress,
                      const CheckpointPlan& checkpoints, bool judges) {
  Run run = simulate_built(scene, std::move(made.built), cache, progress,
                           checkpoints, judges);
  run.scenery = std::move(made.scenery);
  return run;
}

Run simulate_built(const scene::Scene& scene, scene::BuiltScene built,
                   const std::filesystem::path& cache, const Progress& progress,
                   const CheckpointPlan& checkpoints, bool judges) {
  Run run;
  run.scene = scene;
  run.built = std::move(built);
  run.built.settings.passes = dynamics::choose_passes(
      run.built.model, run.built.settings, run.built.initial.t);
  run.history.columns = list_columns(run.built.probes);
  dynamics::Followed followed =
      scene::follow(run.built.probes, run.built.model);
  std::optional<RunLevelObserver> level_observer;
  if (judges) {
    level_observer.emplace(run.scene, run.built, cache);
    followed.motion_observer = level_observer->make_motion_observer();
  }
  const dynamics::Continuation continuation = make_continuation(
      checkpoints, [&] { return make_manifest(run.scene, run.built); },
      run.history, run.printed_warnings);
  try {
    simulate(run.built, progress, run.history, run.statistics, run.record,
             continuation, followed);
  } catch (const NumericalError&) {
    run.failure = std::current_exception();
  }
  include_outputs(run.history, run.record.envelopes);
  for (std::string& text : find_cut_contacts(run.scene.robot, run.built.model,
                                             run.record.contacts)) {
    run.statistics.warnings.push_back(std::move(text));
  }
  if (level_observer) run.levels = level_observer->judge();
  run.history.events = run.statistics.events;
  return run;
}

double repeat_timing(const Run& run, const Progress& progress) {
  results::History history;
  dynamics::SimulationStatistics statistics;
  dynamics::RunRecord record;
  simulate(run.built, progress, history, statistics, record, {}, {});
  return statistics.seconds;
}

Run run_scene(const scene::Scene& scene, const std::filesystem::path& cache,
              const CheckpointPlan& checkpoints) {
  const Progress progress = watch_signals(make_progress_bar());
  PicturedScene made = build_pictured(scene, make_reducer(progress), cache,
                                      make_full_maker(progress));
  warn_of_unused_cache(cache, made.built);
  clear_progress_bar();
  print_more_notes(scene, made.built.notes);
  print_warnings(made.built.warnings);
  const auto unstable = find_unstable_loop(scene, made.built, progress);
  if (unstable) {
    clear_progress_bar();
    print_warnings({*unstable});
  }
  Run run = simulate_pictured(scene, std::move(made), cache, progress,
                              checkpoints, true);
  if (unstable) run.printed_warnings.push_back(*unstable);
  clear_progress_bar();
  print_warnings(run.statistics.warnings);
  return run;
}

}  // namespace limber::app
