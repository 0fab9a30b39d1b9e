// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/json.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/options/cache_option.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/unused_cache.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/app/reports/steady_report.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/parse_number.hpp"
#include "limber/dynamics/analysis/balanced_truncation.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/results/linear_model_file.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/load_scene.hpp"
#include "limber/scene/control/linear_scene.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  SettingOptions settings_given;
  std::string fidelity;
  std::string at = "start";
  std::string file;
  scene::LinearSelection selection;
  int states = 0;  ///< 0: all
  std::string cache;
  bool json = false;
};

/// What the model counts from.
struct Reference {
  dynamics::SystemState state;
  std::string about;  ///< "start", "equilibrium", "time"
  std::string where;  ///< in a sentence
};

/// The time of --at, unless it names a state.
std::optional<double> find_time(const std::string& at) {
  if (at == "start" || at == "equilibrium") return std::nullopt;
  const std::optional<double> time = parse_number(at);
  if (time) return time;
  throw InputError(fmt::format(
      "--at is '{}'; expected 'start', 'equilibrium' or a time of the run in "
      "seconds",
      at));
}

/// The state of the scenario's run at a time.
dynamics::SystemState run_to(double t, const scene::BuiltScene& built,
                             const Progress& progress) {
  dynamics::SystemState state = built.initial;
  dynamics::SimulationSettings settings = built.settings;
  if (!(t >= state.t && t <= settings.end_time)) {
    throw InputError(
        fmt::format("--at is {:g} s; the run goes from {:g} s to {:g} s", t,
                    state.t, settings.end_time));
  }
  if (t == state.t) return state;
  settings.end_time = t;
  settings.output_times = {t};
  std::erase_if(settings.step_changes, [&](const dynamics::StepChange& change) {
    return change.from >= t;
  });
  simulate(
      built.model, state, settings, [](const auto&, const auto&) {}, progress);
  return state;
}

Reference find_reference(const Options& options, const scene::Scene& scene,
                         const scene::BuiltScene& built,
                         const Progress& progress) {
  if (const std::optional<double> t = find_time(options.at)) {
    return {run_to(*t, built, progress), "time",
            fmt::format("the state at {:g} s", *t)};
  }
  if (options.at == "start") {
    return {built.initial, scene.scenario.equilibrium ? "equilibrium" : "start",
            "the start"};
  }
  return {find_equilibrium(built.model, built.initial,
                           {.method = scene.scenario.equilibrium.value_or(
                                dynamics::EquilibriumMethod::newton)},
                           progress)
              .state,
          "equilibrium", "the equilibrium"};
}

/// All that the command found.
struct Found {
  scene::LinearScene linear;
  std::optional<dynamics::TruncatedModel> truncated;
  results::LinearRecord record;
};

void warn(const Reference& reference, Found& found) {
  const dynamics::LinearSystem& system = found.linear.system;
  const LinearisedAt at{reference.where, "the model is"};
  std::vector<std::string>& warnings = found.record.warnings;
  if (system.imbalance.matters) {
    warnings.push_back(
        describe_imbalance(system.imbalance, system.is_moving, at));
  }
  if (system.change > kTellChange) {
    warnings.push_back(describe_change(system.change, at));
  }
  const auto& more = found.linear.warnings;
  warnings.insert(warnings.end(), more.begin(), more.end());
}

void warn_of_fewer(int states, Found& found) {
  const Eigen::Index left = found.truncated->model.A.rows();
  if (left == states) return;
  found.record.warnings.push_back(fmt::format(
      "--states {}: the model has {}; what the others add from inputs to "
      "outputs is less than round-off",
      states, left));
}

Found find(const Options& options) {
  results::check_linear_model_ending(options.file);
  scene::Overrides overrides;
  overrides.settings = to_settings(options.settings_given);
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  const scene::Scene scene = scene::load_scene(options.scenario, overrides);
  const Progress progress = make_progress_bar();
  scene::BuiltScene built = scene::build_system(
      scene, make_reducer(progress), options.cache, make_full_maker(progress));
  warn_of_unused_cache(options.cache, built);
  const Reference reference = find_reference(options, scene, built, progress);
  clear_progress_bar();
  Found found;
  found.linear = scene::linearise(scene.scenario, built.model, reference.state,
                                  built.probes, options.selection);
  found.record.warnings = built.warnings;
  warn(reference, found);
  found.record.model = found.linear.model;
  if (options.states > 0) {
    found.truncated =
        dynamics::truncate_balanced(found.linear.model, options.states);
    found.record.model = found.truncated->model;
    found.record.hankel.assign(found.truncated->hankel.begin(),
                               found.truncated->hankel.end());
    found.record.bound = found.truncated->bound;
    warn_of_fewer(options.states, found);
  }
  const Vector3& w = found.linear.system.axes.w_W;
  found.record.axes_angular_velocity = {w.x(), w.y(), w.z()};
  found.record.time = reference.state.t;
  found.record.scenario = scene.scenario.name;
  found.record.about = reference.about;
  return found;
}

Json to_json(const std::vector<dynamics::LinearSignal>& signals) {
  Json json = Json::array();
  for (const dynamics::LinearSignal& signal : signals) {
    json.push_back({{"name", signal.name},
                    {"unit", signal.unit},
                    {"value", signal.value}});
  }
  return json;
}

void print_json(const Options& options, const Found& found) {
  const results::LinearRecord& record = found.record;
  Json json = Json::object();
  json["scenario"] = options.scenario;
  json["about"] = record.about;
  json["time"] = record.time;
  json["states"] = record.model.states.size();
  json["states_in_all"] = found.linear.model.states.size();
  json["inputs"] = to_json(record.model.inputs);
  json["outputs"] = to_json(record.model.outputs);
  json["axes_angular_velocity"] = record.axes_angular_velocity;
  json["open_loops"] = found.linear.open_loops;
  if (found.truncated) {
    json["states_kept"] = found.truncated->kept;
    json["hankel_singular_values"] = record.hankel;
    json["error_bound"] = record.bound;
  }
  json["file"] = options.file;
  json["warnings"] = record.warnings;
  fmt::print("{}\n", to_text(json));
}

void print_signals(const char* what,
                   const std::vector<dynamics::LinearSignal>& signals) {
  if (signals.empty()) fmt::print("no {}s\n", what);
  for (const dynamics::LinearSignal& signal : signals) {
    fmt::print("{:<7} {:<28} {:13.6g} {}\n", what, signal.name,
               signal.value + 0.0, signal.unit);  // no -0
  }
}

void print_truncation(const dynamics::TruncatedModel& truncated,
                      Eigen::Index all) {
  const Eigen::Index n = truncated.model.A.rows();
  fmt::print("{} of {} states", n, all);
  if (truncated.kept > 0) {
    fmt::print(", {} of them of motion that does not decay", truncated.kept);
  }
  fmt::print(
      "; at no frequency does the gain from inputs to outputs differ by more "
      "than {:.4g}\n",
      truncated.bound);
  const Eigen::Index balanced = n - truncated.kept;
  const auto list = [&](Eigen::Index from, Eigen::Index count) {
    std::string text;
    constexpr Eigen::Index kMost = 8;
    for (Eigen::Index i = from; i < from + std::min(count, kMost); ++i) {
      text += fmt::format(" {:.3g}", truncated.hankel[i]);
    }
    return text + (count > kMost ? " ..." : "");
  };
  if (balanced > 0) {
    fmt::print("Hankel singular values kept:    {}\n", list(0, balanced));
  }
  const Eigen::Index out = truncated.hankel.size() - balanced;
  if (out > 0) {
    fmt::print("Hankel singular values left out:{}\n", list(balanced, out));
  }
}

void print(const Options& options, const Found& found) {
  const results::LinearRecord& record = found.record;
  fmt::print(
      "Linear model of {} about the {}, t = {:g} s: {} states, {} of "
      "them of free motion\n",
      record.scenario, record.about == "time" ? "motion" : record.about,
      record.time, found.linear.model.states.size(),
      2 * found.linear.system.free);
  const Vector3& w = found.linear.system.axes.w_W;
  if (!w.isZero(0.0)) {
    fmt::print(
        "vectors of the world frame are seen from axes that turn with it, at "
        "({:.6g}, {:.6g}, {:.6g}) rad/s\n",
        w.x(), w.y(), w.z());
  }
  print_signals("input", record.model.inputs);
  print_signals("output", record.model.outputs);
  if (!found.linear.open_loops.empty()) {
    fmt::print(
        "open loops: {} {} not in it; what {} is an input\n",
        fmt::join(found.linear.open_loops, ", "),
        found.linear.open_loops.size() == 1 ? "is" : "are",
        found.linear.open_loops.size() == 1 ? "it writes" : "each writes");
  }
  if (found.truncated) {
    print_truncation(*found.truncated, std::ssize(found.linear.model.states));
  }
  fmt::print("model in {}\n", options.file);
}

void linearize(const Options& options) {
  const Found found = find(options);
  results::write_linear_model(options.file, found.record);
  print_warnings(found.record.warnings);
  if (options.json) {
    print_json(options, found);
  } else {
    print(options, found);
  }
}

}  // namespace

void add_linearize(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "linearize",
      "Linear model (A, B, C, D) of a scenario's system: inputs are its loads, "
      "drives and controllers' inputs, outputs its probes");
  command->add_option("scenario", options->scenario, "Scenario file (.toml)")
      ->required();
  command
      ->add_option("-o,--output", options->file,
                   "File of the model: .mat, .npz or .json")
      ->required();
  add_settings(*command, options->settings_given);
  command->add_option("--at", options->at,
                      "start, equilibrium, or a time of the run [s] "
                      "(default: start)");
  command
      ->add_option("--inputs", options->selection.inputs,
                   "Names of inputs, separated by commas (default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--outputs", options->selection.outputs,
                   "Names of probes or their columns, separated by commas "
                   "(default: all)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--states", options->states,
                   "Reduce to so many states by balanced truncation")
      ->check(make_positive());
  command
      ->add_option("--fidelity", options->fidelity,
                   "Level of every flexible link, in place of the file's")
      ->type_name("LEVEL");
  add_cache_option(*command, options->cache);
  command->add_flag("--json", options->json, "Print one JSON object");
  command->callback(
      [&action, options] { action = [options] { linearize(*options); }; });
}

}  // namespace limber::app
