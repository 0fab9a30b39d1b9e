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
#include "limber/app/options/list_option.hpp"
#include "limber/app/options/reducer.hpp"
#include "limber/app/options/scene_loading.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/options/validators.hpp"
#include "limber/results/linear_model_file.hpp"
#include "limber/runs/analyses/linear_run.hpp"

namespace limber::app {
namespace {

struct LinearizeOptions {
  std::string scenario;
  SettingOptions settings_given;
  std::optional<std::string> fidelity;
  std::string at = "start";
  std::string file;
  scene::LinearSelection selection;
  int states = 0;  ///< 0: all
  bool closes_loops = false;
  std::string cache;
  bool json = false;
};

runs::LinearRun find_linear_run(const LinearizeOptions& options) {
  results::check_linear_model_ending(options.file);
  const runs::LinearRequest request = {runs::parse_reference(options.at),
                                       options.selection, options.states,
                                       options.closes_loops};
  const scene::Scene scene = load_with_notes(
      options.scenario, to_overrides(options.settings_given, options.fidelity));
  const Progress progress = make_progress_bar();
  runs::LinearRun run = linearise_scene(
      scene, request, make_reductions(options.cache, progress), progress);
  clear_progress_bar();
  print_more_notes(scene, run.notes);
  return run;
}

Json list_signals(const std::vector<dynamics::LinearSignal>& signals) {
  Json json = Json::array();
  for (const dynamics::LinearSignal& signal : signals) {
    json.push_back({{"name", signal.name},
                    {"unit", signal.unit},
                    {"value", signal.value}});
  }
  return json;
}

void print_linear_json(const LinearizeOptions& options,
                       const runs::LinearRun& found) {
  const results::LinearRecord& record = found.record;
  Json json = Json::object();
  json["scenario"] = options.scenario;
  json["about"] = record.about;
  json["time"] = record.time;
  json["states"] = record.model.states.size();
  json["states_in_all"] = found.linear.model.states.size();
  json["inputs"] = list_signals(record.model.inputs);
  json["outputs"] = list_signals(record.model.outputs);
  json["axes_angular_velocity"] = record.axes_angular_velocity;
  json["open_loops"] = found.linear.open_loops;
  if (record.period > 0.0) json["period"] = record.period;
  if (found.truncated) {
    json["states_kept"] = found.truncated->kept;
    json["hankel_singular_values"] = record.hankel;
    json["error_bound"] = record.bound;
  }
  json["file"] = options.file;
  json["notes"] = found.notes;
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

void print_linear_model(const LinearizeOptions& options,
                        const runs::LinearRun& found) {
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
        "vectors of the world frame are expressed in axes that rotate with it, "
        "at ({:.6g}, {:.6g}, {:.6g}) rad/s\n",
        w.x(), w.y(), w.z());
  }
  if (record.period > 0.0) {
    fmt::print(
        "with its controllers, from sample to sample: {} states, period {:g} "
        "s\n",
        record.model.states.size(), record.period);
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

void linearize(const LinearizeOptions& options) {
  const runs::LinearRun found = find_linear_run(options);
  results::write_linear_model(options.file, found.record);
  print_warnings(found.record.warnings);
  if (options.json) {
    print_linear_json(options, found);
  } else {
    print_linear_model(options, found);
  }
}

}  // namespace

void add_linearize(CLI::App& app, Action& action) {
  const auto options = std::make_shared<LinearizeOptions>();
  CLI::App* command = app.add_subcommand(
      "linearize",
      "Linear model (A, B, C, D) of a scenario's system: inputs are its loads, "
      "drives and controllers' inputs, outputs its probes");
  add_scenario(*command, options->scenario);
  command
      ->add_option("-o,--output", options->file,
                   "File of the model: .mat, .npz or .json")
      ->required();
  add_settings(*command, options->settings_given);
  command->add_option("--at", options->at,
                      "start, equilibrium, or a time of the run [s] "
                      "(default: start)");
  add_list(*command, "--inputs", options->selection.inputs,
           "Names of inputs, separated by commas (default: all)")
      ->type_name("INPUTS")
      ->allow_extra_args(false);
  add_list(*command, "--outputs", options->selection.outputs,
           "Names of probes or their columns, separated by commas (default: "
           "all)")
      ->type_name("PROBES")
      ->allow_extra_args(false);
  command
      ->add_option("--states", options->states,
                   "Reduce to this number of states by balanced truncation")
      ->check(make_positive());
  command->add_flag("--closed-loop", options->closes_loops,
                    "With the controllers: a discrete model, from sample to "
                    "sample");
  add_fidelity(*command, options->fidelity);
  add_cache_option(*command, options->cache);
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { linearize(*options); }; });
}

}  // namespace limber::app
