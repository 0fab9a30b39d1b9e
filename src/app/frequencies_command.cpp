// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/json.hpp"
#include "app/reducer.hpp"
#include "app/terminal.hpp"
#include "app/validators.hpp"
#include "dynamics/natural_frequencies.hpp"
#include "flexbody/cache.hpp"
#include "scene/scene.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  std::string fidelity;
  std::string cache;
  int count = 20;
  bool json = false;
};

void find_frequencies(const Options& options) {
  scene::Overrides overrides;
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  const scene::Scene scene = scene::load_scene(options.scenario, overrides);
  const scene::BuiltScene built = scene::build_system(
      scene, make_reducer(make_progress_bar()),
      options.cache.empty() ? flexbody::default_cache_folder()
                            : std::filesystem::path(options.cache));
  clear_progress_bar();
  print_warnings(built.warnings);
  const VectorX all =
      dynamics::find_natural_frequencies(built.model, built.initial);
  const VectorX first =
      all.head(std::min<Eigen::Index>(options.count, all.size()));
  if (options.json) {
    Json json = Json::object();
    json["scenario"] = options.scenario;
    json["frequencies"] = std::vector<double>(first.begin(), first.end());
    fmt::print("{}\n", to_text(json));
    return;
  }
  fmt::print("Small motion about the start of {}\n", scene.scenario.name);
  fmt::print("{:>5}  {:>14}\n", "", "frequency [Hz]");
  for (Eigen::Index i = 0; i < first.size(); ++i) {
    fmt::print("{:>5}  {:>14.6g}{}\n", i + 1, first[i],
               first[i] == 0.0  ? "  moves freely"
               : first[i] < 0.0 ? "  unstable"
                                : "");
  }
}

}  // namespace

void add_frequencies(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "frequencies",
      "Natural frequencies of a scenario's whole system about its start, held "
      "by its couplers and drives");
  command->add_option("scenario", options->scenario, "Scenario file (.toml)")
      ->required();
  command->add_option("--fidelity", options->fidelity,
                      "Level of every flexible link, in place of the file's");
  command->add_option("--count", options->count, "How many, from the lowest")
      ->check(make_positive());
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback([&action, options] {
    action = [options] { find_frequencies(*options); };
  });
}

}  // namespace limber::app
