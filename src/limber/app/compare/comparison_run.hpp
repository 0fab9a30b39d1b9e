// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/runs/compare/comparison.hpp"

namespace limber::app {

struct ComparisonRequest {
  std::filesystem::path scenario;
  std::vector<scene::Setting> settings;  ///< applied to it in every run
  std::filesystem::path folder;          ///< of results
  std::filesystem::path cache;           ///< empty for the default one
  bool keep_runs = false;                ///< a folder for each run
  int repeats = 0;                       ///< as runs::ComparisonSettings
  Progress watch = {};                   ///< likewise
};

/// runs::compare_runs with a progress bar, printed notes and warnings, and the
/// folders of kept runs.
[[nodiscard]] runs::Comparison run_comparison(const runs::ComparisonPlan& plan,
                                              const ComparisonRequest& request);

}  // namespace limber::app
