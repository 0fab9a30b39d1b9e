// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/reports/static_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/static_files.hpp"
#include "limber/common/errors.hpp"
#include "limber/runs/numbered_stages.hpp"

namespace limber::app {
namespace {

struct StaticOptions {
  std::string scenario;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string method;
  std::string out;
  std::string cache;
  bool json = false;
  bool xdmf = false;
};

scene::Scene load_static_scene(const StaticOptions& options) {
  return load_with_notes(
      options.scenario, to_overrides(options.settings_given, options.fidelity));
}

dynamics::EquilibriumMethod find_method(const StaticOptions& options,
                                        const scene::Scenario& scenario) {
  if (!options.method.empty()) {
    return dynamics::parse_equilibrium_method(options.method);
  }
  return scenario.equilibrium.value_or(dynamics::EquilibriumMethod::newton);
}

void print_static_run(const runs::StaticRun& run,
                      const std::filesystem::path& folder) {
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

void report_equilibrium(const StaticOptions& options) {
  const scene::Scene scene = load_static_scene(options);
  const OutputFolder folder(
      find_results_folder(options.out, scene.scenario.name + "-static"));
  const Progress progress = make_progress_bar();
  const runs::StaticRun run = runs::find_static(
      scene, find_method(options, scene.scenario),
      make_reductions(options.cache, runs::number_stage(progress, 1, 2)),
      progress);
  clear_progress_bar();
  folder.write([&](const std::filesystem::path& place) {
    write_static(run, place, options.xdmf || run.scene.scenario.output.xdmf);
  });
  print_more_notes(scene, run.built.notes);
  print_warnings(run.warnings);
  if (options.json) {
    Json summary = summarize(run);
    summary["folder"] = folder.path().string();
    fmt::print("{}\n", to_text(summary));
    return;
  }
  print_static_run(run, folder.path());
}

}  // namespace

void add_static(CLI::App& app, Action& action) {
  const auto options = std::make_shared<StaticOptions>();
  CLI::App* command =
      app.add_subcommand("static",
                         "Static equilibrium of a scenario under all that acts "
                         "at its start: loads, gravity, couplers, drives");
  add_scenario(*command, options->scenario);
  add_settings(*command, options->settings_given);
  add_fidelity(*command, options->fidelity);
  command->add_option("--method", options->method,
                      "newton: load stepping from the start; relaxation: "
                      "damped motion to an equilibrium, however distant");
  add_out(*command, options->out, "<scenario name>-static");
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->add_flag("--xdmf", options->xdmf, "Write files for ParaView");
  command->callback([&action, options] {
    action = [options] { report_equilibrium(*options); };
  });
}

}  // namespace limber::app
