// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/json.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/reports/frequency_report.hpp"

namespace limber::app {
namespace {

struct FrequenciesOptions {
  std::string scenario;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string cache;
  std::optional<int> count;
  bool json = false;
};

void report_frequencies(const FrequenciesOptions& options) {
  const scene::Scene scene = load_with_notes(
      options.scenario, to_overrides(options.settings_given, options.fidelity));
  FrequencyReport report =
      find_frequencies(scene, options.cache, make_progress_bar());
  clear_progress_bar();
  if (options.count && *options.count > std::ssize(report.modes.modes)) {
    report.warnings.push_back(fmt::format(
        "--count {}: there are {}", *options.count, report.modes.modes.size()));
  }
  print_more_notes(scene, report.notes);
  print_warnings(report.warnings);
  constexpr int kDefaultCount = 20;
  const int count = options.count.value_or(kDefaultCount);
  if (options.json) {
    fmt::print("{}\n", to_text(to_json(report, count)));
  } else {
    fmt::print("{}", to_text(report, count));
  }
}

}  // namespace

void add_frequencies(CLI::App& app, Action& action) {
  const auto options = std::make_shared<FrequenciesOptions>();
  CLI::App* command = app.add_subcommand(
      "frequencies",
      "Natural frequencies of a scenario's whole system about its start, held "
      "by its couplers and drives");
  add_scenario(*command, options->scenario);
  add_settings(*command, options->settings_given);
  add_fidelity(*command, options->fidelity);
  command
      ->add_option("--count", options->count,
                   "How many, from the lowest (default: 20)")
      ->check(make_positive());
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback([&action, options] {
    action = [options] { report_frequencies(*options); };
  });
}

}  // namespace limber::app
