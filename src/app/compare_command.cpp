// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "app/commands.hpp"
#include "app/comparison.hpp"
#include "common/errors.hpp"
#include "dynamics/fidelity.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  std::vector<std::string> fidelity;
  std::string out;
  std::string cache;
  bool json = false;
};

std::vector<dynamics::Fidelity> parse_levels(
    const std::vector<std::string>& names) {
  if (names.size() < 2) {
    throw InputError(
        "--fidelity: compare needs at least two levels, as in "
        "--fidelity rigid,coupled");
  }
  std::vector<dynamics::Fidelity> levels;
  levels.reserve(names.size());
  for (const std::string& name : names) {
    levels.push_back(dynamics::parse_fidelity(name));
  }
  return levels;
}

Comparison compute(const Options& options,
                   const std::filesystem::path& folder) {
  Comparison comparison;
  comparison.levels = options.fidelity;
  for (const dynamics::Fidelity level : parse_levels(options.fidelity)) {
    scene::Overrides overrides;
    overrides.fidelity = level;
    const scene::Scene scene = scene::load_scene(options.scenario, overrides);
    const std::filesystem::path own =
        folder / std::string(dynamics::to_string(level));
    check_output_folder(own);
    comparison.runs.push_back(run_scene(scene, options.cache));
    write_run(comparison.runs.back(), own, scene.scenario.output.xdmf);
    if (comparison.runs.back().failure) {
      std::rethrow_exception(comparison.runs.back().failure);
    }
  }
  return comparison;
}

void compare(const Options& options) {
  (void)parse_levels(options.fidelity);
  const std::filesystem::path folder =
      options.out.empty()
          ? std::filesystem::path("out") /
                (std::filesystem::path(options.scenario).stem().string() +
                 "-compare")
          : std::filesystem::path(options.out);
  // The scenario first: its errors tell more than those of the folder.
  (void)scene::load_scene(options.scenario);
  check_output_folder(folder);
  const Comparison comparison = compute(options, folder);
  write_comparison(comparison, folder);
  if (options.json) {
    Json json = to_json(comparison);
    json["folder"] = folder.string();
    fmt::print("{}\n", to_text(json));
  } else {
    fmt::print("{}results in {}\n", to_text(comparison), folder.string());
  }
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "compare", "Simulate a scenario at several levels of fidelity");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")
      ->required();
  command
      ->add_option("--fidelity", options->fidelity,
                   "Levels, separated by commas; the last is the reference")
      ->delimiter(',')
      ->required();
  command->add_option("--out", options->out,
                      "Results folder (default: out/<scenario name>-compare)");
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { compare(*options); }; });
}

}  // namespace limber::app
