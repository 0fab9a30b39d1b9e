// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/reports/level_report.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/common/errors.hpp"
#include "limber/results/charts/level_picture.hpp"

namespace limber::app {
namespace {

struct AdviseOptions {
  std::string scenario;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string out;
  std::string cache;
  dynamics::AdviceSettings settings;
  bool json = false;
};

scene::Scene load_advise_scene(const AdviseOptions& options) {
  scene::Scene scene = load_with_notes(
      options.scenario, to_overrides(options.settings_given, options.fidelity));
  dynamics::AdviceSettings& advice = scene.scenario.advice;
  const auto replace = [](auto& value, const auto& other) {
    if (other) value = other;
  };
  replace(advice.displacement, options.settings.displacement);
  replace(advice.linear_limit, options.settings.linear_limit);
  replace(advice.force, options.settings.force);
  dynamics::check(advice);
  return scene;
}

void write_picture(const std::filesystem::path& file, const std::string& title,
                   const std::vector<runs::BodyLevel>& levels) {
  std::vector<results::RotationTrack> tracks;
  for (const runs::BodyLevel& level : levels) {
    tracks.push_back({level.name, level.reduced, level.limits.displacement,
                      level.limits.linear_limit, level.track});
  }
  const std::string why_none =
      results::draw_rotation_plane(file, title, tracks);
  if (!why_none.empty()) print_warnings({why_none});
}

void advise(const AdviseOptions& options) {
  const scene::Scene scene = load_advise_scene(options);
  const OutputFolder folder(
      find_results_folder(options.out, scene.scenario.name + "-advise"));
  const runs::SceneAdvice advice =
      app::advise(scene, options.cache, make_progress_bar());
  clear_progress_bar();
  print_more_notes(scene, advice.notes);
  print_warnings(advice.warnings);
  Json json = to_json(advice);
  json["folder"] = folder.path().string();
  folder.write([&](const std::filesystem::path& place) {
    write_text(place / "advice.json", to_text(json));
    if (scene.scenario.output.pictures) {
      write_picture(place / "advice.png", scene.scenario.name, advice.levels);
    }
  });
  if (options.json) {
    fmt::print("{}\n", to_text(json));
    return;
  }
  for (const runs::BodyLevel& level : advice.levels) {
    fmt::print("{}\n", to_text(level));
  }
  fmt::print("{}\nresults in {}\n", to_fidelity_table(advice.levels),
             folder.path().string());
}

}  // namespace

void add_advise(CLI::App& app, Action& action) {
  const auto options = std::make_shared<AdviseOptions>();
  CLI::App* command = app.add_subcommand(
      "advise", "Recommend a level of fidelity for every flexible link");
  add_scenario(*command, options->scenario);
  command
      ->add_option("--displacement", options->settings.displacement,
                   "Displacement to neglect [m] (default: 2e-7 of the body's "
                   "longest edge)")
      ->check(make_positive());
  command
      ->add_option("--linear-limit", options->settings.linear_limit,
                   "Deformation at which linear elasticity ends [m] (default: "
                   "1 % of the body's longest edge)")
      ->check(make_positive());
  command
      ->add_option("--force-limit", options->settings.force,
                   "Nodal inertial force to neglect [N] (default: none)")
      ->check(make_positive());
  add_settings(*command, options->settings_given);
  command
      ->add_option("--fidelity", options->fidelity,
                   "Level to judge, of every flexible link, in place of the "
                   "scenario's")
      ->type_name("LEVEL");
  add_out(*command, options->out, "<scenario name>-advise");
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { advise(*options); }; });
}

}  // namespace limber::app
