// SPDX-License-Identifier: BSD-3-Clause
#include "limber/runs/analyses/static_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/monitors/deflection_observer.hpp"
#include "limber/runs/level_judgement.hpp"
#include "limber/runs/numbered_stages.hpp"
#include "limber/runs/pictured_scene.hpp"
#include "limber/runs/probe_columns.hpp"
#include "limber/runs/unused_cache.hpp"

namespace limber::runs {
namespace {

void observe_equilibrium(StaticRun& run) {
  const dynamics::SystemState& state = run.found.state;
  run.history.columns = list_columns(run.built.probes);
  run.history.times = {state.t};
  run.history.probe_rows = {
      scene::evaluate_all(run.built.probes, run.built.model, state)};
  run.history.states = {state};
  run.history.energies = {calc_energy(run.built.model, state)};
}

bool is_unstable(const StaticReport& report) {
  return report.lowest_frequency && *report.lowest_frequency < 0.0;
}

void add_static_warnings(const Reductions& reductions, StaticRun& run) {
  run.warnings = run.built.warnings;
  RunLevelObserver level_observer(run.scene, run.built, reductions);
  level_observer.include(run.found.state);
  const auto levels = find_level_warnings(level_observer.judge());
  run.warnings.insert(run.warnings.end(), levels.begin(), levels.end());
  const auto holds =
      dynamics::find_constraint_warnings(run.built.model, run.found.state);
  run.warnings.insert(run.warnings.end(), holds.begin(), holds.end());
  if (is_unstable(run.report)) {
    run.warnings.push_back(fmt::format(
        "this equilibrium is unstable: a disturbance grows as exp(2 pi {:.3g} "
        "Hz t)",
        -*run.report.lowest_frequency));
  }
}

/// Newton's method may jump to another branch in one load step, as beyond
/// buckling. In small ones it follows that of the start.
void follow_branch(StaticRun& run, const Progress& progress) {
  constexpr double kFraction = 0.05;
  if (run.method != dynamics::EquilibriumMethod::newton) return;
  try {
    const dynamics::Equilibrium found = find_equilibrium(
        run.built.model, run.built.initial, {.largest_fraction = kFraction},
        number_stage(progress, 2, 2));
    const StaticReport stable = report_equilibrium(run.built, found);
    if (is_unstable(stable)) return;
    run.found = found;
    run.report = stable;
  } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
    // The branch of the start ends before the whole load: what was found stays.
  }
}

}  // namespace

StaticRun find_static(const scene::Scene& scene,
                      dynamics::EquilibriumMethod method,
                      const Reductions& reductions, const Progress& progress) {
  StaticRun run;
  run.scene = scene;
  run.method = method;
  run.scene.scenario.equilibrium.reset();
  PicturedScene made = build_pictured(run.scene, reductions);
  run.built = std::move(made.built);
  run.scenery = std::move(made.scenery);
  warn_of_unused_cache(reductions.cache, run.built);
  run.found =
      find_equilibrium(run.built.model, run.built.initial,
                       {.method = run.method}, number_stage(progress, 2, 2));
  if (run.found.load_steps == 0) {
    throw InputError(fmt::format(
        "{}: nothing acts on the system at its start, which is the trivial "
        "equilibrium; give it a load, gravity or a drive that pulls",
        run.scene.scenario.file.string()));
  }
  run.report = report_equilibrium(run.built, run.found);
  if (is_unstable(run.report)) follow_branch(run, progress);
  observe_equilibrium(run);
  run.stress = find_stress_peaks(run.built, run.history,
                                 record_state(run.built, run.found.state));
  add_static_warnings(reductions, run);
  return run;
}

}  // namespace limber::runs
