// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/study/study_collection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <memory>

#include "limber/app/study/study_runner.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/records/manifest.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

struct Place {
  fs::path file;
  std::size_t run = 0;
};

Place split_place(const std::string& place) {
  const std::size_t hash = place.rfind('#');
  const auto run = hash == std::string::npos
                       ? std::nullopt
                       : scene::to_index(place.substr(hash + 1));
  if (!run) {
    throw InputError(
        fmt::format("'{}' is not a run of a study; expected FILE#RUN, for "
                    "example study.sqlite#17",
                    place));
  }
  return {place.substr(0, hash), *run};
}

}  // namespace

std::size_t collect_study(const std::vector<std::string>& files,
                          const fs::path& made) {
  std::error_code ignored;
  if (fs::exists(made, ignored)) {
    throw InputError(
        fmt::format("'{}' already exists; choose another folder with --out",
                    made.string()));
  }
  std::map<std::size_t, std::pair<study::StudyRow, std::string>> rows;
  study::StudyRecord record;
  for (const std::string& name : files) {
    const study::StudyFile file{fs::path(name)};
    if (record.manifest.empty()) {
      record = file.record();
    } else {
      const auto differences = find_differences(
          Manifest(record.manifest), Manifest(file.record().manifest));
      if (!differences.empty()) {
        throw InputError(
            fmt::format("'{}' belongs to another study than '{}': {}", name,
                        files.front(), fmt::join(differences, "; ")));
      }
    }
    for (study::StudyRow& row : file.read_rows()) {
      const std::size_t run = row.run;
      const auto [at, is_new] = rows.try_emplace(run, std::move(row), name);
      if (is_new) continue;
      throw InputError(
          fmt::format("run {} is in '{}' and in '{}'; shards have "
                      "no runs in common",
                      run, at->second.second, name));
    }
  }
  record.shard = 0;
  record.shards = 1;
  study::StudyFile whole(made, record);
  std::vector<study::StudyRow> all;
  for (auto& [run, row] : rows) all.push_back(std::move(row.first));
  whole.add(all);
  return all.size();
}

StudiedRun find_studied_run(const std::string& place) {
  const Place found = split_place(place);
  const study::StudyFile file(found.file);
  const study::Study& study = file.record().study;
  const study::Design design = make_design(study);
  if (found.run >= design.size()) {
    throw InputError(fmt::format(
        "'{}' has {} runs, 0 to {}; there is no run "
        "{}",
        found.file.string(), design.size(), design.size() - 1, found.run));
  }
  return {study.scenario, to_overrides(study, design[found.run]),
          fmt::format("{}-{}", study.name, found.run), file.record().manifest};
}

void check_is_unchanged(const std::string& place, const fs::path& cache) {
  const Place found = split_place(place);
  const study::StudyFile file(found.file);
  const study::Study& study = file.record().study;
  const StudyBase base = make_base(study, make_design(study), cache);
  std::vector<std::string> differences = find_differences(
      Manifest(file.record().manifest), Manifest(base.manifest));
  std::erase_if(differences, [](const std::string& text) {
    return text.starts_with("build of Limber");
  });
  if (differences.empty()) return;
  throw InputError(fmt::format(
      "'{}' was made from another version of '{}': {}; restore that version",
      found.file.string(), study.scenario.string(),
      fmt::join(differences, "; ")));
}

}  // namespace limber::app
