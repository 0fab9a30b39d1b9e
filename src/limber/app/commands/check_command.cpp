// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/run/scene_check.hpp"
#include "limber/scene/build/load_scene.hpp"

namespace limber::app {
namespace {

struct CheckOptions {
  std::string scenario;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string cache;
  bool json = false;
};

void check_scenario(const CheckOptions& options) {
  const scene::Scene scene = scene::load_scene(
      options.scenario, to_overrides(options.settings_given, options.fidelity));
  const SceneCheck check =
      check_scene(scene, options.cache, make_progress_bar());
  clear_progress_bar();
  fmt::print("{}",
             options.json ? to_text(to_json(check)) + "\n" : to_text(check));
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Report masses, frequencies against the step, cost and parts without "
      "effect, within seconds and without a run");
  add_scenario(*command, options->scenario);
  add_settings(*command, options->settings_given);
  add_fidelity(*command, options->fidelity);
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { check_scenario(*options); }; });
}

}  // namespace limber::app
