// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/commands.hpp"
#include "app/levels.hpp"
#include "app/reducer.hpp"
#include "app/run_scene.hpp"
#include "app/terminal.hpp"
#include "app/text_file.hpp"
#include "app/validators.hpp"
#include "common/errors.hpp"
#include "flexbody/cache.hpp"
#include "results/level_picture.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  std::string fidelity;
  std::string out;
  std::string cache;
  dynamics::AdviceSettings settings;
  bool json = false;
};

/// More instants than this tell nothing new.
constexpr double kMostInstants = 1e6;

/// Every step and every jump of a load.
std::vector<double> find_instants(const dynamics::SystemModel& model,
                                  const dynamics::SimulationSettings& time) {
  std::vector<double> instants;
  const double step = std::max(time.step, time.end_time / kMostInstants);
  for (double i = 0.0; i * step < time.end_time; ++i) {
    instants.push_back(i * step);
  }
  instants.push_back(time.end_time);
  for (const dynamics::Load& load : model.loads) {
    for (const double t : break_times(load.function)) {
      if (t > 0.0 && t < time.end_time) instants.push_back(t);
    }
  }
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  return instants;
}

scene::Scene load(const Options& options) {
  scene::Overrides overrides;
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  scene::Scene scene = scene::load_scene(options.scenario, overrides);
  dynamics::AdviceSettings& advice = scene.scenario.advice;
  const auto replace = [](auto& value, const auto& other) {
    if (other) value = other;
  };
  replace(advice.displacement, options.settings.displacement);
  replace(advice.linear_limit, options.settings.linear_limit);
  replace(advice.force, options.settings.force);
  dynamics::check(advice);
  for (const scene::Link& link : scene.robot.links) {
    if (link.flexible) return scene;
  }
  throw InputError(
      fmt::format("{}: no link is flexible; there is no level to choose",
                  scene.robot.file.string()));
}

/// The levels that the scenario asks for, one a body.
std::vector<dynamics::Fidelity> find_asked(const scene::Scenario& scenario,
                                           const dynamics::SystemModel& model) {
  std::vector<dynamics::Fidelity> asked;
  for (const dynamics::BodyModel& body : model.bodies) {
    const auto found = scenario.fidelity_of_link.find(body.name);
    asked.push_back(found == scenario.fidelity_of_link.end() ? scenario.fidelity
                                                             : found->second);
  }
  return asked;
}

std::vector<BodyLevel> find_levels(const scene::Scene& scene,
                                   const std::filesystem::path& cache) {
  const Progress progress = make_progress_bar();
  scene::Scene flexible_scene = scene;
  flexible_scene.scenario.fidelity = dynamics::Fidelity::uncoupled;
  flexible_scene.scenario.fidelity_of_link.clear();
  const scene::BuiltScene flexible = scene::build_system(
      flexible_scene, make_reducer(progress),
      cache.empty() ? flexbody::default_cache_folder() : cache);
  const scene::BuiltScene rigid =
      build_at_level(scene, dynamics::Fidelity::rigid, flexible.model, cache);
  clear_progress_bar();
  print_warnings(flexible.warnings);
  dynamics::LevelSurvey survey(flexible.model);
  dynamics::SimulationSettings settings = rigid.settings;
  settings.output_times = find_instants(rigid.model, settings);
  dynamics::SystemState state = rigid.initial;
  const auto observer = [&](const dynamics::SystemState& now,
                            const dynamics::EnergyBalance&) {
    survey.include(rigid.model, now);
  };
  dynamics::simulate(rigid.model, state, settings, observer, progress);
  clear_progress_bar();
  std::vector<BodyLevel> levels = judge_levels(
      flexible.model, survey, find_asked(scene.scenario, flexible.model),
      scene.scenario.advice);
  find_bounds(levels);
  return levels;
}

void write_picture(const std::filesystem::path& file, const std::string& title,
                   const std::vector<BodyLevel>& levels) {
  std::vector<results::RotationTrack> tracks;
  for (const BodyLevel& level : levels) {
    tracks.push_back({level.name, level.reduced, level.limits.displacement,
                      level.limits.linear_limit, level.track});
  }
  const std::string why_none =
      results::draw_rotation_plane(file, title, tracks);
  if (!why_none.empty()) print_warnings({why_none});
}

Json summarize(const scene::Scene& scene, const std::vector<BodyLevel>& levels,
               const std::filesystem::path& folder) {
  Json json = Json::object();
  json["scenario"] = scene.scenario.file.string();
  json["bodies"] = Json::array();
  for (const BodyLevel& level : levels)
    json["bodies"].push_back(to_json(level));
  json["fidelity_table"] = to_fidelity_table(levels);
  json["folder"] = folder.string();
  return json;
}

void advise(const Options& options) {
  const scene::Scene scene = load(options);
  const std::filesystem::path folder =
      options.out.empty()
          ? std::filesystem::path("out") / (scene.scenario.name + "-advise")
          : std::filesystem::path(options.out);
  check_output_folder(folder);
  const std::vector<BodyLevel> levels = find_levels(scene, options.cache);
  const Json json = summarize(scene, levels, folder);
  write_text(folder / "advice.json", to_text(json));
  if (scene.scenario.output.pictures) {
    write_picture(folder / "advice.png", scene.scenario.name, levels);
  }
  if (options.json) {
    fmt::print("{}\n", to_text(json));
    return;
  }
  for (const BodyLevel& level : levels) fmt::print("{}\n", to_text(level));
  fmt::print("{}\nresults in {}\n", to_fidelity_table(levels), folder.string());
}

}  // namespace

void add_advise(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "advise", "Recommend a level of fidelity for every flexible link");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")
      ->required();
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
  command->add_option("--fidelity", options->fidelity,
                      "Level to judge, of every flexible link, in place of "
                      "the scenario's");
  command->add_option("--out", options->out,
                      "Results folder (default: out/<scenario name>-advise)");
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { advise(*options); }; });
}

}  // namespace limber::app
