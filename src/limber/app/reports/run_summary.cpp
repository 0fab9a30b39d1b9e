// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/run_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "limber/app/console/json.hpp"
#include "limber/common/echo.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/input_file.hpp"
#include "limber/results/checkpoint_file.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

constexpr InputKind kSummaryInput = {"summary", std::uint64_t{1} << 28};

bool has_file(const fs::path& folder, const char* name) {
  std::error_code error;
  return fs::exists(folder / name, error);
}

/// Why a folder without a run's summary has none.
[[noreturn]] void refuse_folder(const fs::path& folder) {
  std::string what = "has neither summary.json nor checkpoint.bin of a run";
  if (has_file(folder, "study.sqlite")) {
    what =
        "belongs to a study; simulate one of its runs by limber run --from "
        "FOLDER/study.sqlite#RUN, and explain that";
  } else if (has_file(folder, "comparison.json")) {
    what = "belongs to a comparison; explain one of the runs in its folders";
  } else if (has_file(folder, "advice.json")) {
    what = "belongs to limber advise, which keeps no record of its run";
  }
  throw InputError(fmt::format("'{}' {}", folder.string(), what));
}

template <typename Value>
Value get_or(const Json& json, const char* key, const Value& other) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? other : found->get<Value>();
}

/// Without controls, which would reach a terminal.
std::string read_text(const Json& text) {
  return escape_controls(text.get<std::string>());
}

std::vector<std::string> read_texts(const Json& list) {
  std::vector<std::string> texts;
  for (const Json& text : list) texts.push_back(read_text(text));
  return texts;
}

std::map<std::string, double> read_numbers(const Json& json) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] : json.items()) {
    numbers[escape_controls(name)] = value.get<double>();
  }
  return numbers;
}

void read_steps(const Json& json, RunSummary& run) {
  run.steps = json.at("steps").get<long>();
  run.iterations = json.at("newton_iterations").get<long>();
  run.halved = json.at("steps_halved").get<long>();
  run.rejected = get_or(json, "steps_rejected", 0L);
  run.tolerance = get_or(json, "tolerance", 0.0);
  run.integrator = read_text(json.at("integrator"));
  run.step = json.at("step").get<double>();
  run.step_changes = get_or(json, "step_changes", 0L);
  run.seconds_offline = json.at("seconds_offline").get<double>();
  run.seconds = json.at("seconds_online").get<double>();
  const Json& limits = json.at("step_limits");
  for (const Json& limit : limits.at("by")) {
    run.limits.push_back(
        {read_text(limit.at("limit")), limit.at("count").get<double>(),
         limit.at("time").get<double>(), limit.at("shortest").get<double>()});
  }
  run.by_body = read_numbers(limits.at("bodies"));
  run.by_pair = read_numbers(limits.at("pairs"));
  run.parts = read_numbers(json.at("seconds_by_part"));
}

void read_energy(const Json& json, RunSummary& run) {
  if (json.empty()) return;
  run.unbalanced_fraction = json.at("open_share").get<double>();
  run.open_place = read_text(json.at("place"));
  for (const Json& row : json.at("rows")) {
    run.rows.push_back(
        {read_text(row.at("name")), row.at("stored").get<double>(),
         row.at("in").get<double>(), row.at("out").get<double>(),
         row.at("lost").get<double>(), row.at("error").get<double>()});
  }
}

void read_lists(const Json& json, RunSummary& run) {
  for (const Json& event : json.at("events")) {
    run.events.push_back(
        {event.at("time").get<double>(), read_text(event.at("source")),
         read_text(event.at("what")), event.at("rate").get<double>(),
         event.at("iterations").get<int>()});
  }
  for (const Json& level : json.at("levels")) {
    run.levels.push_back({read_text(level.at("body")),
                          read_text(level.at("used")),
                          read_text(level.at("recommended")),
                          level.at("more_than_needed").get<bool>()});
  }
  if (json.contains("contact_meshes")) {
    run.meshed = read_texts(json["contact_meshes"]);
  }
  run.has_errors = json.contains("errors");
  run.warnings = read_texts(json.at("warnings"));
}

void read_end(const Json& json, RunSummary& run) {
  run.scenario = read_text(json.at("scenario"));
  run.reached = json.at("reached").get<double>();
  run.end_time = json.at("end_time").get<double>();
  if (json.at("completed").get<bool>()) return;
  run.failure = read_text(json.at("failure"));
  run.end =
      json.at("interrupted").get<bool>() ? RunEnd::stopped : RunEnd::failed;
}

void read_json(const fs::path& file, RunSummary& run) {
  const std::string text = read_input(file, kSummaryInput);
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) {
    throw InputError(
        fmt::format("'{}' is damaged: its JSON is incomplete", file.string()));
  }
  try {
    if (!json.contains("steps")) {
      throw InputError(fmt::format("'{}' is not the summary of a run in time",
                                   file.string()));
    }
    read_end(json, run);
    read_steps(json, run);
    read_energy(json.at("energy"), run);
    read_lists(json, run);
  } catch (const Json::exception& error) {
    throw InputError(fmt::format(
        "'{}' is damaged, or of another version of limber; simulate it again "
        "({})",
        file.string(), error.what()));
  }
}

void read_checkpoint_of(const fs::path& file, RunSummary& run) {
  const results::CheckpointRecord record = results::read_checkpoint(file);
  run.end = RunEnd::killed;
  run.reached = record.run.time;
  run.events = record.history.events;
}

}  // namespace

std::string find_most(const std::map<std::string, double>& counts) {
  const auto most = std::max_element(
      counts.begin(), counts.end(),
      [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

RunSummary read_run_summary(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError(fmt::format(
        "'{}' is not a folder; expected the results folder of a run",
        folder.string()));
  }
  RunSummary run;
  run.folder = folder.string();
  run.has_checkpoint = has_file(folder, "checkpoint.bin");
  if (has_file(folder, "summary.json")) {
    read_json(folder / "summary.json", run);
    // A later run here was killed.
    const auto changed = [&](const char* name) {
      return fs::last_write_time(folder / name, error);
    };
    if (!run.has_checkpoint || run.end != RunEnd::finished ||
        changed("checkpoint.bin") < changed("summary.json")) {
      return run;
    }
    RunSummary later;
    later.folder = run.folder;
    later.scenario = run.scenario;
    later.has_checkpoint = true;
    run = later;
  } else if (!run.has_checkpoint) {
    refuse_folder(folder);
  }
  read_checkpoint_of(folder / "checkpoint.bin", run);
  return run;
}

}  // namespace limber::app
