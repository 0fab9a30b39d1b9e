// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/study/study_file.hpp"

namespace limber::app {

/// Joins files of shards into one new file of the whole study.
/// @returns its number of rows
/// @throws InputError if they are of different studies, two have a run in
/// common, or the new file exists.
std::size_t collect_study(const std::vector<std::string>& files,
                          const std::filesystem::path& made);

/// One run of a study's results, "study.sqlite#17".
struct StudiedRun {
  std::filesystem::path scenario;
  scene::Overrides overrides;
  std::string name;      ///< "struck-17"
  std::string manifest;  ///< of the study
};
/// @throws InputError if there is no such run.
[[nodiscard]] StudiedRun find_studied_run(const std::string& place);

/// @throws InputError if the scenario has changed since the study, naming the
/// differences.
void check_is_unchanged(const std::string& place,
                        const std::filesystem::path& cache);

}  // namespace limber::app
