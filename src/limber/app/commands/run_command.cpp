// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/errors/error_runs.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/app/run/view_page.hpp"
#include "limber/app/study/study_collection.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/system/fidelity.hpp"
#include "limber/results/checkpoint_file.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/view/page.hpp"

namespace limber::app {
namespace {

struct RunOptions {
  std::string scenario;
  std::string from;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string out;
  std::string cache;
  std::optional<double> checkpoint_interval;
  bool resumes = false;
  bool json = false;
  bool xdmf = false;
  bool views = false;
  bool errors = false;
};

std::filesystem::path find_run_folder(const RunOptions& options,
                                      const scene::Scenario& scenario) {
  if (options.out.empty() && !scenario.output.folder.empty()) {
    return scenario.output.folder;
  }
  return find_results_folder(options.out, scenario.name);
}

StudiedRun find_run(const RunOptions& options) {
  if (!options.scenario.empty()) {
    throw InputError(
        "--from already selects the scenario; do not give another");
  }
  check_is_unchanged(options.from, options.cache);
  return find_studied_run(options.from);
}

void estimate_errors(runs::Run& run, const std::string& cache) {
  try {
    add_errors(run, app::estimate_errors(run, cache,
                                         watch_signals(make_progress_bar())));
  } catch (const std::exception& error) {
    run.given_warnings.push_back(
        fmt::format("errors are unknown: {}", error.what()));
    print_warnings({run.given_warnings.back()});
  }
  clear_progress_bar();
}

void run_scenario(const RunOptions& options) {
  if (options.views) view::find_template();  // before a long run
  scene::Overrides overrides =
      to_overrides(options.settings_given, options.fidelity);
  std::string scenario = options.scenario;
  std::string name;
  if (!options.from.empty()) {
    const StudiedRun studied = find_run(options);
    overrides = scene::merge(studied.overrides, overrides);
    scenario = studied.scenario;
    name = studied.name;
  } else if (scenario.empty()) {
    throw InputError("limber run needs a scenario, or --from");
  }
  scene::Scene scene = load_with_notes(scenario, overrides);
  if (!name.empty()) scene.scenario.name = name;
  const OutputFolder folder(find_run_folder(options, scene.scenario));
  DeferredSignals signals;
  const runs::CheckpointPlan checkpoints = {
      folder.path() / "checkpoint.bin",
      options.checkpoint_interval.value_or(
          scene.scenario.output.checkpoint_interval),
      options.resumes};
  runs::Run result = run_scene(scene, options.cache, checkpoints, &signals);
  if (options.checkpoint_interval && result.statistics.steps == 0 &&
      !result.failure) {
    result.given_warnings.emplace_back(
        "--checkpoint-interval changes nothing: the run took no steps, because "
        "its solution is in closed form");
    print_warnings({result.given_warnings.back()});
  }
  if ((options.errors || scene.scenario.output.errors) && !result.failure) {
    estimate_errors(result, options.cache);
  }
  folder.write([&](const std::filesystem::path& place) {
    write_run(result, place, options.xdmf || scene.scenario.output.xdmf);
  });
  if (find_received_signal() == 0) results::remove_checkpoint(checkpoints.file);
  finish_run(result, folder, options.json);
  if (!options.views) return;
  const std::filesystem::path page =
      add_view_to(folder, read_recordings({folder.path()}));
  if (!options.json) fmt::print("{}\n", describe_view(page));
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Simulate a scenario");
  add_scenario(*command, options->scenario)->required(false);
  command->add_option("--from", options->from,
                      "FILE#RUN: a run of a study, for example "
                      "study.sqlite#17, instead of a scenario");
  add_settings(*command, options->settings_given);
  add_fidelity(*command, options->fidelity);
  add_out(*command, options->out, "<scenario name>");
  add_cache_option(*command, options->cache);
  command->add_flag("--resume", options->resumes,
                    "Continue from the checkpoint in the results folder");
  command
      ->add_option("--checkpoint-interval", options->checkpoint_interval,
                   "Wall time between checkpoints [s] (default: 60)")
      ->check(make_not_negative());
  add_json(*command, options->json);
  command->add_flag("--xdmf", options->xdmf, "Write files for ParaView");
  command->add_flag("--errors", options->errors,
                    "Errors of all probes by cause, each from one more run");
  command->add_flag("--view", options->views,
                    "Write a page that shows the motion in a browser");
  command->callback(
      [&action, options] { action = [options] { run_scenario(*options); }; });
}

}  // namespace limber::app
