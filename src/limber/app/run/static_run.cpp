// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/static_run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/dynamics/monitors/deflection_observer.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/probes_csv.hpp"
#include "limber/results/results_file.hpp"
#include "limber/results/xdmf.hpp"
#include "limber/runs/level_judgement.hpp"
#include "limber/runs/numbered_stages.hpp"
#include "limber/runs/pictured_scene.hpp"
#include "limber/runs/probe_columns.hpp"
#include "limber/runs/unused_cache.hpp"

namespace limber::app {
namespace {

void observe_equilibrium(StaticRun& run) {
  const dynamics::SystemState& state = run.found.state;
  run.history.columns = runs::list_columns(run.built.probes);
  run.history.times = {state.t};
  run.history.probe_rows = {
      scene::evaluate_all(run.built.probes, run.built.model, state)};
  run.history.states = {state};
  run.history.energies = {calc_energy(run.built.model, state)};
}

bool is_unstable(const StaticReport& report) {
  return report.lowest_frequency && *report.lowest_frequency < 0.0;
}

void add_static_warnings(const runs::Reductions& reductions, StaticRun& run) {
  run.warnings = run.built.warnings;
  runs::RunLevelObserver level_observer(run.scene, run.built, reductions);
  level_observer.include(run.found.state);
  const auto levels = runs::find_level_warnings(level_observer.judge());
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
        runs::number_stage(progress, 2, 2));
    const StaticReport stable = report_equilibrium(run.built, found);
    if (is_unstable(stable)) return;
    run.found = found;
    run.report = stable;
  } catch (const NumericalError&) {  // NOLINT(bugprone-empty-catch)
    // The branch of the start ends before the whole load: what was found stays.
  }
}

/// Magnifies small displacements to be visible.
double find_exaggeration(const dynamics::Equilibrium& found) {
  constexpr double kSeen = 0.1;  // of the extent
  const double fraction = found.distance / found.extent;
  if (fraction == 0.0 || fraction > 0.2 * kSeen) return 1.0;
  return std::pow(10.0, std::floor(std::log10(kSeen / fraction)));
}

void draw(const StaticRun& run, const std::filesystem::path& file) {
  const std::string why_none = results::draw_displacement(
      file, run.scene.scenario.name, run.built.model, run.built.initial,
      run.found.state, find_exaggeration(run.found), run.scenery);
  if (!why_none.empty()) print_warnings({why_none});
}

}  // namespace

StaticRun find_static(const scene::Scene& scene,
                      dynamics::EquilibriumMethod method,
                      const std::filesystem::path& cache,
                      const Progress& progress) {
  const runs::Reductions reductions =
      make_reductions(cache, runs::number_stage(progress, 1, 2));
  StaticRun run;
  run.scene = scene;
  run.method = method;
  run.scene.scenario.equilibrium.reset();
  runs::PicturedScene made = runs::build_pictured(run.scene, reductions);
  run.built = std::move(made.built);
  run.scenery = std::move(made.scenery);
  runs::warn_of_unused_cache(cache, run.built);
  run.found = find_equilibrium(run.built.model, run.built.initial,
                               {.method = run.method},
                               runs::number_stage(progress, 2, 2));
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

Json summarize(const StaticRun& run) {
  Json json = Json::object();
  json["scenario"] = run.scene.scenario.file.string();
  json["method"] = dynamics::equilibrium_method_names().at(
      static_cast<std::size_t>(run.method));
  json["load_steps"] = run.found.load_steps;
  json["newton_iterations"] = run.found.newton_iterations;
  json["relaxation_steps"] = run.found.relaxation_steps;
  json.update(to_json(run.report));
  Json probes = Json::object();
  for (std::size_t i = 0; i < run.history.columns.size(); ++i) {
    probes[run.history.columns[i].name] =
        Json{{"value", run.history.probe_rows[0][i]},
             {"unit", run.history.columns[i].unit}};
  }
  json["probes"] = probes;
  if (run.scene.scenario.output.stress) json["stress"] = to_json(run.stress);
  json["notes"] = run.built.notes;
  json["warnings"] = run.warnings;
  return json;
}

void write_static(const StaticRun& run, const std::filesystem::path& folder,
                  bool xdmf) {
  results::write_results(folder / "results.h5", run.built.model, run.history,
                         &run.scenery);
  results::write_probes_csv(folder / "probes.csv", run.history);
  write_text(folder / "summary.json", to_text(summarize(run)));
  if (xdmf) {
    print_warnings(results::write_xdmf(folder / "motion.xdmf", run.built.model,
                                       run.history));
  }
  if (run.scene.scenario.output.pictures) draw(run, folder / "equilibrium.png");
}

}  // namespace limber::app
