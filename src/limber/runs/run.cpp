// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/run.hpp"

#include <optional>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/simulation/tolerance_loop.hpp"
#include "limber/runs/cut_contacts.hpp"
#include "limber/runs/probe_columns.hpp"
#include "limber/runs/run_manifest.hpp"
#include "limber/runs/unused_cache.hpp"
#include "limber/scene/probes/followed_probes.hpp"

namespace limber::runs {
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
    const std::vector<double> row = history.probe_rows[i];
    for (std::size_t c = 0; c < row.size(); ++c) {
      include(envelopes, c, row[c], history.times[i]);
    }
  }
}

}  // namespace

Run simulate_scene(const scene::Scene& scene, const RunOptions& options) {
  PicturedScene made = build_pictured(scene, options.reductions);
  warn_of_unused_cache(options.reductions.cache, made.built);
  return simulate_pictured(scene, std::move(made), options);
}

Run simulate_pictured(const scene::Scene& scene, PicturedScene made,
                      const RunOptions& options) {
  Run run = simulate_built(scene, std::move(made.built), options);
  run.scenery = std::move(made.scenery);
  return run;
}

Run simulate_built(const scene::Scene& scene, scene::BuiltScene built,
                   const RunOptions& options) {
  Run run;
  run.scene = scene;
  run.built = std::move(built);
  run.built.settings.passes = dynamics::choose_passes(
      run.built.model, run.built.settings, run.built.initial.t);
  run.history.columns = list_columns(run.built.probes);
  dynamics::Followed followed =
      scene::follow(run.built.probes, run.built.model);
  std::optional<RunLevelObserver> level_observer;
  if (options.judges_levels) {
    level_observer.emplace(run.scene, run.built, options.reductions);
    followed.motion_observer = level_observer->make_motion_observer();
  }
  const dynamics::Continuation continuation = make_continuation(
      options.checkpoints, [&] { return make_manifest(run.scene, run.built); },
      run.history, options.warn, run.given_warnings);
  if (options.starts) options.starts();
  try {
    simulate(run.built, options.progress, run.history, run.statistics,
             run.record, continuation, followed);
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

}  // namespace limber::runs
