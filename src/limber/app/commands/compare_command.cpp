// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <set>
#include <string>

#include "limber/app/commands/commands.hpp"
#include "limber/app/compare/comparison_pictures.hpp"
#include "limber/app/compare/comparison_report.hpp"
#include "limber/app/compare/comparison_run.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/list_option.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/run/output_folder.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/percent.hpp"
#include "limber/runs/compare/comparison_selection.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/build/scenario_writer.hpp"
#include "limber/scene/text/toml_file.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::string scenario;
  SettingOptions settings;
  std::vector<std::string> levels;
  runs::Axes axes;  ///< without levels
  std::string reference;
  std::string reference_integrator;
  runs::ReferenceWish wish;  ///< without a level and an integrator
  std::string tolerance;
  std::string measure;
  int repeats = 0;
  bool keep = false;
  std::string out;
  std::string cache;
  bool json = false;
};

runs::Axes make_axes(const CompareOptions& options) {
  runs::Axes axes = options.axes;
  for (const std::string& name : options.levels) {
    axes.levels.push_back(dynamics::parse_fidelity(name));
  }
  return axes;
}

runs::ReferenceWish make_wish(const CompareOptions& options) {
  runs::ReferenceWish wish = options.wish;
  if (!options.reference.empty()) {
    wish.level = dynamics::parse_fidelity(options.reference);
  }
  if (!options.reference_integrator.empty()) {
    wish.integrator = dynamics::parse_integrator(options.reference_integrator);
  }
  return wish;
}

std::optional<runs::Demand> make_demand(const CompareOptions& options) {
  if (options.tolerance.empty() && !options.measure.empty()) {
    throw InputError(
        "--measure selects the error that --tolerance applies to; give "
        "--tolerance as well");
  }
  const runs::ErrorMeasure measure = runs::parse_error_measure(
      options.measure.empty() ? "both" : options.measure);
  if (options.tolerance.empty()) return std::nullopt;
  return runs::Demand{runs::parse_tolerance(options.tolerance), measure};
}

ComparisonRequest make_settings(const CompareOptions& options) {
  ComparisonRequest settings;
  settings.scenario = options.scenario;
  settings.folder = find_results_folder(
      options.out, fs::path(options.scenario).stem().string() + "-compare");
  settings.settings = to_settings(options.settings);
  settings.cache = options.cache;
  settings.repeats = options.repeats;
  // Levels alone give few runs; other axes multiply them.
  settings.keep_runs = options.keep || (options.axes.eigenmodes.empty() &&
                                        options.axes.sources.empty() &&
                                        options.axes.steps.empty());
  return settings;
}

/// Settings that the file does not contain, because they belong to the robot.
std::string describe_robot_settings(const ComparisonRequest& settings) {
  std::string text;
  const auto sorted = scene::sort_settings(
      settings.settings, scene::parse_toml_file(settings.scenario));
  for (const scene::RobotSetting& setting : sorted.robots) {
    text += fmt::format("# Run it with {}, which is not in this file.\n",
                        to_string(setting.setting));
  }
  return text;
}

void write_chosen(const runs::ComparedRun& run, const runs::Demand& demand,
                  const ComparisonRequest& settings, const fs::path& place) {
  const auto error = find_error(run.error->error, demand.measure);
  write_text(
      place / "chosen.toml",
      fmt::format(
          "# {}: the cheapest choice within {} that limber compare found,\n"
          "#   {}\n"
          "# with an error of {}. The original's comments are lost.\n{}\n{}",
          settings.scenario.filename().string(), to_percent(demand.tolerance),
          describe(run.choice), to_percent(error),
          describe_robot_settings(settings),
          scene::rewrite_scenario(settings.scenario,
                                  to_overrides(run.choice, settings.settings),
                                  settings.folder)));
}

Json chosen_to_json(const runs::Demand& demand, const runs::ComparedRun* chosen,
                    const fs::path& file) {
  Json json{{"tolerance", demand.tolerance},
            {"measure", to_string(demand.measure)},
            {"run", nullptr}};
  if (chosen == nullptr) return json;
  json["run"] = describe(chosen->choice);
  json["error"] = *find_error(chosen->error->error, demand.measure);
  json["scenario"] = file.string();
  return json;
}

std::string describe_chosen(const runs::Demand& demand,
                            const runs::ComparedRun& chosen,
                            const runs::Comparison& comparison,
                            const fs::path& file,
                            const ComparisonRequest& settings) {
  return fmt::format(
      "Cheapest within {}: '{}', error {}, {:.3g} times cheaper than the "
      "reference; {}\n{}",
      to_percent(demand.tolerance), describe(chosen.choice),
      to_percent(find_error(chosen.error->error, demand.measure)),
      comparison.reference.cost.online / chosen.cost.online, file.string(),
      describe_robot_settings(settings));
}

/// Text and pictures of the comparison.
class ComparisonWriter {
 public:
  ComparisonWriter(const runs::Comparison& comparison,
                   const std::optional<runs::Demand>& demand,
                   const ComparisonRequest& settings)
      : comparison_(comparison),
        demand_(demand),
        settings_(settings),
        chosen_(demand ? find_cheapest(comparison, *demand) : nullptr),
        file_(chosen_ == nullptr ? fs::path()
                                 : settings.folder / "chosen.toml"),
        json_(to_json(comparison)) {
    if (demand) json_["chosen"] = chosen_to_json(*demand, chosen_, file_);
  }

  void write(const fs::path& place, bool pictures) const {
    if (chosen_ != nullptr) write_chosen(*chosen_, *demand_, settings_, place);
    write_text(place / "comparison.json", to_text(json_));
    if (!pictures) return;
    draw_comparison(comparison_, place,
                    demand_ ? std::optional(demand_->tolerance) : std::nullopt);
  }

  void print(bool as_json) const {
    if (as_json) {
      Json json = json_;
      json["folder"] = settings_.folder.string();
      fmt::print("{}\n", to_text(json));
      return;
    }
    fmt::print("{}", to_text(comparison_));
    if (chosen_ != nullptr) {
      fmt::print("{}", describe_chosen(*demand_, *chosen_, comparison_, file_,
                                       settings_));
    }
    fmt::print("results in {}\n", settings_.folder.string());
  }

 private:
  const runs::Comparison& comparison_;
  const std::optional<runs::Demand>& demand_;
  const ComparisonRequest& settings_;
  const runs::ComparedRun* chosen_;
  fs::path file_;
  Json json_;
};

std::set<std::string> find_run_folders(const runs::ComparisonPlan& plan,
                                       const ComparisonRequest& settings) {
  if (!settings.keep_runs) return {};
  std::set<std::string> names = {"reference"};
  for (const runs::Choice& choice : plan.runs)
    names.insert(make_folder_name(choice));
  return names;
}

void compare(const CompareOptions& options) {
  const runs::Axes axes = make_axes(options);
  const runs::ReferenceWish wish = make_wish(options);
  const std::optional<runs::Demand> demand = make_demand(options);
  const ComparisonRequest settings = make_settings(options);
  const scene::Scene scene =
      load_with_notes(options.scenario, {.settings = settings.settings});
  const runs::ComparisonPlan plan = make_plan(axes, wish, scene);
  // Errors of the scene are found before anything is written.
  for (const runs::Choice& choice : plan.runs) {
    (void)scene::load_scene(options.scenario,
                            to_overrides(choice, settings.settings));
  }
  OutputFolder folder(settings.folder);
  folder.claim(find_run_folders(plan, settings));
  // Before the runs, so that a user can stop them at once.
  const std::string note = describe_default_reference(plan);
  if (!note.empty()) fmt::print(stderr, "limber: {}\n", note);
  const runs::Comparison comparison = run_comparison(plan, settings);
  const ComparisonWriter writer(comparison, demand, settings);
  folder.write([&](const fs::path& place) {
    writer.write(place, scene.scenario.output.pictures);
  });
  writer.print(options.json);
  if (demand && find_cheapest(comparison, *demand) == nullptr) {
    refuse(comparison, *demand);
  }
}

void add_axes(CLI::App& command, CompareOptions& options) {
  add_list(command, "--fidelity", options.levels,
           "Levels, for example rigid,coupled (default: rigid to coupled, up "
           "to the reference's)")
      ->type_name("LEVELS");
  add_list(command, "--modes", options.axes.eigenmodes,
           "Numbers of eigenmodes of every flexible link, for example 4,10,20 "
           "(default: the scenario's)",
           CLI::Range(0, 100000));
  add_list(
      command, "--sources", options.axes.sources,
      "Vectors of the bases: eigenmodes only, or with the static-deformation "
      "modes of interfaces, loads, or all (default: the scenario's)");
  add_list(command, "--step", options.axes.steps,
           "Longest steps [s], for example 1e-3,5e-4 (default: the scenario's)",
           make_positive());
}

void add_reference(CLI::App& command, CompareOptions& options) {
  command.add_option("--reference", options.reference,
                     "Level of the reference (default: the costliest with a "
                     "reduced basis; `full` takes whole meshes)");
  command
      .add_option("--reference-modes", options.wish.eigenmodes,
                  "Its eigenmodes (default: the most that are compared)")
      ->check(CLI::Range(0, 100000));
  command
      .add_option("--reference-step", options.wish.step,
                  "Its step [s] (default: half of the shortest that is "
                  "compared)")
      ->check(make_positive());
  command.add_option("--reference-integrator", options.reference_integrator,
                     "Its integrator, for example central-differences for "
                     "level full (default: the scenario's)");
}

void add_demand(CLI::App& command, CompareOptions& options) {
  command.add_option("--tolerance", options.tolerance,
                     "Largest error, for example 1% or 0.01: choose the "
                     "cheapest run that meets it and write it as chosen.toml");
  command.add_option("--measure", options.measure,
                     "Error that the tolerance applies to: displacement, "
                     "deformation, or both (default): the larger one");
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
      app.add_subcommand("compare",
                         "Simulate a scenario at several levels, bases and "
                         "steps; measure the cost and the error of each");
  add_scenario(*command, options->scenario);
  add_settings(*command, options->settings);
  add_axes(*command, *options);
  add_reference(*command, *options);
  add_demand(*command, *options);
  command
      ->add_option("--repeat", options->repeats,
                   "Number of timed runs, of which the fastest counts "
                   "(default: as many as fit in 0.2 s)")
      ->check(CLI::Range(1, 1000));
  command->add_flag("--keep", options->keep,
                    "Keep the results of every run (default: where levels are "
                    "the only axis)");
  add_out(*command, options->out, "<scenario name>-compare");
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { compare(*options); }; });
}

}  // namespace limber::app
