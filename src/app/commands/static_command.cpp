// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/reports/levels.hpp"
#include "limber/app/reports/static_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/run_scenery.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/probes_csv.hpp"
#include "limber/results/results_file.hpp"
#include "limber/results/xdmf.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  SettingOptions settings_given;
  std::string fidelity;
  std::string method;
  std::string out;
  std::string cache;
  bool json = false;
  bool xdmf = false;
};

/// An equilibrium as a run with one state.
struct StaticRun {
  scene::Scene scene;
  scene::BuiltScene built;  ///< its initial state is the start
  dynamics::EquilibriumMethod method = dynamics::EquilibriumMethod::newton;
  dynamics::Equilibrium found;
  results::History history;
  StaticReport report;
  std::vector<StressPeak> stress;  ///< of the equilibrium
  std::vector<std::string> warnings;
};

scene::Scene load(const Options& options) {
  scene::Overrides overrides;
  overrides.settings = to_settings(options.settings_given);
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  return scene::load_scene(options.scenario, overrides);
}

dynamics::EquilibriumMethod find_method(const Options& options,
                                        const scene::Scenario& scenario) {
  if (!options.method.empty()) {
    return dynamics::parse_equilibrium_method(options.method);
  }
  return scenario.equilibrium.value_or(dynamics::EquilibriumMethod::newton);
}

void observe(StaticRun& run) {
  const dynamics::SystemState& state = run.found.state;
  for (const scene::Probe& probe : run.built.probes) {
    for (const auto& column : scene::column_names(probe)) {
      run.history.columns.push_back({column.name, column.unit});
    }
  }
  run.history.times = {state.t};
  run.history.probe_rows = {
      scene::evaluate_all(run.built.probes, run.built.model, state)};
  run.history.states = {state};
  run.history.energies = {calc_energy(run.built.model, state)};
}

void warn(const Options& options, StaticRun& run) {
  run.warnings = run.built.warnings;
  RunSurvey survey(run.scene, run.built, options.cache);
  survey.include(run.found.state);
  const auto levels = find_level_warnings(survey.judge());
  run.warnings.insert(run.warnings.end(), levels.begin(), levels.end());
  const std::optional<double>& lowest = run.report.lowest_frequency;
  if (lowest && *lowest < 0.0) {
    run.warnings.push_back(fmt::format(
        "this equilibrium is unstable: a disturbance grows as exp(2 pi {:.3g} "
        "Hz t)",
        -*lowest));
  }
}

StaticRun find(const Options& options) {
  const Progress progress = make_progress_bar();
  StaticRun run;
  run.scene = load(options);
  run.method = find_method(options, run.scene.scenario);
  run.scene.scenario.equilibrium.reset();
  run.built = scene::build_system(run.scene, make_reducer(progress),
                                  options.cache, make_full_maker(progress));
  run.found = find_equilibrium(run.built.model, run.built.initial,
                               {.method = run.method}, progress);
  clear_progress_bar();
  if (run.found.load_steps == 0) {
    throw InputError(fmt::format(
        "{}: nothing acts on the system at its start, which is the trivial "
        "equilibrium; give it a load, gravity or a drive that pulls",
        run.scene.scenario.file.string()));
  }
  observe(run);
  run.report = report_equilibrium(run.built, run.found);
  run.stress = find_stress_peaks(run.built, run.history,
                                 record_state(run.built, run.found.state));
  warn(options, run);
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
  json["warnings"] = run.warnings;
  return json;
}

/// Magnifies small displacements to be visible.
double find_exaggeration(const dynamics::Equilibrium& found) {
  constexpr double kSeen = 0.1;  // of the extent
  const double share = found.distance / found.extent;
  if (share == 0.0 || share > 0.2 * kSeen) return 1.0;
  return std::pow(10.0, std::floor(std::log10(kSeen / share)));
}

void draw(const StaticRun& run, const std::filesystem::path& file) {
  const std::string why_none = results::draw_displacement(
      file, run.scene.scenario.name, run.built.model, run.built.initial,
      run.found.state, find_exaggeration(run.found));
  if (!why_none.empty()) print_warnings({why_none});
}

void write(const StaticRun& run, const std::filesystem::path& folder,
           bool xdmf) {
  results::Scenery scenery = read_scenery_texts(run.scene);
  add_shapes(run.scene, run.built, scenery);
  results::write_results(folder / "results.h5", run.built.model, run.history,
                         &scenery);
  results::write_probes_csv(folder / "probes.csv", run.history);
  write_text(folder / "summary.json", to_text(summarize(run)));
  if (xdmf) {
    results::write_xdmf(folder / "motion.xdmf", run.built.model, run.history);
  }
  if (run.scene.scenario.output.pictures) draw(run, folder / "equilibrium.png");
}

void print(const StaticRun& run, const std::filesystem::path& folder) {
  fmt::print("equilibrium in {} load steps, {} Newton iterations",
             run.found.load_steps, run.found.newton_iterations);
  if (run.found.relaxation_steps > 0) {
    fmt::print(" after {} steps of relaxation", run.found.relaxation_steps);
  }
  fmt::print("\n{}", to_text(run.report));
  for (std::size_t i = 0; i < run.history.columns.size(); ++i) {
    fmt::print("{:<28} {:13.6g} {}\n", run.history.columns[i].name,
               run.history.probe_rows[0][i], run.history.columns[i].unit);
  }
  fmt::print("{}", to_text(run.stress));
  fmt::print("results in {}\n", folder.string());
}

void find_static(const Options& options) {
  const OutputFolder folder(
      options.out.empty()
          ? std::filesystem::path("out") /
                (std::filesystem::path(options.scenario).stem().string() +
                 "_static")
          : std::filesystem::path(options.out));
  const StaticRun run = find(options);
  folder.write([&](const std::filesystem::path& place) {
    write(run, place, options.xdmf || run.scene.scenario.output.xdmf);
  });
  print_warnings(run.warnings);
  if (options.json) {
    Json summary = summarize(run);
    summary["folder"] = folder.path().string();
    fmt::print("{}\n", to_text(summary));
    return;
  }
  print(run, folder.path());
}

}  // namespace

void add_static(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "static",
      "Static equilibrium of a scenario under what acts at its start: loads, "
      "gravity, couplers, drives");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")
      ->required();
  add_settings(*command, options->settings_given);
  command->add_option("--fidelity", options->fidelity,
                      "Level of every flexible link, in place of the file's");
  command->add_option("--method", options->method,
                      "newton: load stepping from the start; relaxation: "
                      "falls to an equilibrium, however far");
  command->add_option("--out", options->out,
                      "Results folder (default: out/<scenario name>_static)");
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_flag("--xdmf", options->xdmf, "Write files for ParaView");
  command->callback(
      [&action, options] { action = [options] { find_static(*options); }; });
}

}  // namespace limber::app
