// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <thread>

#include "limber/app/commands/commands.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/options/setting_options.hpp"
#include "limber/app/options/shared_options.hpp"
#include "limber/app/study/study_collection.hpp"
#include "limber/app/study/study_pictures.hpp"
#include "limber/app/study/study_runner.hpp"
#include "limber/app/study/study_table.hpp"
#include "limber/common/errors.hpp"
#include "limber/study/study_reader.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

struct StudyCommandOptions {
  std::string study;
  std::vector<std::string> collected;
  std::string shard;
  std::string out;
  std::string cache;
  SettingOptions robots;
  int jobs = 0;
  bool csv = false;
  bool json = false;
};

struct Shard {
  std::size_t index = 0;
  std::size_t count = 1;
};

Shard parse_shard(const std::string& text) {
  if (text.empty()) return {};
  const std::size_t slash = std::min(text.find('/'), text.size() - 1);
  const auto k = scene::to_index(text.substr(0, slash));
  const auto n = scene::to_index(text.substr(slash + 1));
  if (!k || !n || *k < 1 || *k > *n) {
    throw InputError(fmt::format(
        "--shard '{}': expected K/N with K from 1 to N, for example 2/8",
        text));
  }
  return {*k - 1, *n};
}

fs::path make_folder(const StudyCommandOptions& options,
                     const std::string& name) {
  fs::path folder = find_results_folder(options.out, name);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(fmt::format("results folder '{}' cannot be made: {}",
                                 folder.string(), error.message()));
  }
  return folder;
}

/// Responses that no completed run has.
std::vector<std::string> list_without_values(
    const study::Study& study, const std::vector<study::StudyRow>& rows) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < study.responses.size(); ++i) {
    bool is_done = false;
    bool has_value = false;
    for (const study::StudyRow& row : rows) {
      is_done |= row.error.empty();
      has_value |= row.error.empty() && row.responses.at(i).has_value();
    }
    if (is_done && !has_value) names.push_back(study.responses[i].name);
  }
  return names;
}

int find_jobs(const StudyCommandOptions& options) {
  if (options.jobs > 0) return options.jobs;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Tables of a file of results.
void finish(const StudyCommandOptions& options, const fs::path& file,
            const fs::path& folder, const StudyCost& cost) {
  const study::StudyFile results(file);
  const study::StudyRecord& record = results.record();
  const std::vector<study::StudyRow> rows = results.read_rows();
  const StudyFindings findings = find_findings(record.study, record.runs, rows);
  if (options.csv) {
    write_text(fs::path(file).replace_extension(".csv"),
               to_csv(record.study, rows));
  }
  for (const std::string& name : list_without_values(record.study, rows)) {
    print_warnings(
        {fmt::format("response '{}' has no value in any run", name)});
  }
  if (record.shards == 1) draw_study(record.study, rows, findings, folder);
  if (options.json) {
    Json json = to_json(record.study, record.runs, rows, findings);
    json["file"] = file.string();
    json["seconds"] = cost.seconds;
    json["seconds_steps"] = cost.seconds_steps;
    fmt::print("{}\n", to_text(json));
    return;
  }
  fmt::print("{}", to_text(record.study, record.runs, rows, findings));
  if (cost.runs > 0) {
    fmt::print("{} runs in {:.3g} s, {:.3g} s of steps\n", cost.runs,
               cost.seconds, cost.seconds_steps);
  }
  if (rows.size() < record.runs) {
    fmt::print("{} of {} runs are there\n", rows.size(), record.runs);
  }
  fmt::print("results in {}\n", file.string());
}

void run_one(const StudyCommandOptions& options) {
  study::Study study = study::read_study(fs::path(options.study));
  for (const scene::Setting& one : to_settings(options.robots)) {
    study.settings.push_back(one);
  }
  const Shard shard = parse_shard(options.shard);
  const study::Design design = make_design(study);
  const StudyBase base = make_base(study, design, options.cache);
  const fs::path folder = make_folder(options, study.name);
  const fs::path path =
      folder / (shard.count == 1 ? "study.sqlite"
                                 : fmt::format("study-{}-of-{}.sqlite",
                                               shard.index + 1, shard.count));
  StudyCost cost;
  {
    study::StudyFile file(
        path, {study, base.manifest, design.size(), shard.index, shard.count});
    cost = run_study(design, base, {options.cache, find_jobs(options)}, file);
  }
  finish(options, path, folder, cost);
}

void collect(const StudyCommandOptions& options) {
  if (!options.study.empty() || !options.shard.empty()) {
    throw InputError(
        "--collect takes only files of results, without a study file and "
        "--shard");
  }
  const fs::path folder = make_folder(options, "collected");
  const fs::path file = folder / "study.sqlite";
  (void)collect_study(options.collected, file);
  finish(options, file, folder, {});
}

void run_study_file(const StudyCommandOptions& options) {
  if (!options.collected.empty()) return collect(options);
  if (options.study.empty()) {
    throw InputError(
        "limber study needs a study file (TOML), or --collect "
        "with files of results");
  }
  run_one(options);
}

}  // namespace

void add_study(CLI::App& app, Action& action) {
  const auto options = std::make_shared<StudyCommandOptions>();
  CLI::App* command =
      app.add_subcommand("study",
                         "Run a scenario many times with varied values, with "
                         "all results in one table");
  command->add_option("study", options->study, "Study file (TOML)");
  command->add_option("--collect", options->collected,
                      "Join results of shards into one file");
  command->add_option(
      "--shard", options->shard,
      "K/N: only every N-th run from the K-th on, into a separate file");
  command
      ->add_option("--jobs", options->jobs,
                   "Runs at a time (default: as many as processors)")
      ->check(CLI::Range(1, 1024));
  add_out(*command, options->out, "<study name>");
  add_cache_option(*command, options->cache);
  add_robot_options(*command, options->robots);
  command->add_flag("--csv", options->csv, "Also write the table as CSV");
  add_json(*command, options->json);
  command->callback(
      [&action, options] { action = [options] { run_study_file(*options); }; });
}

}  // namespace limber::app
