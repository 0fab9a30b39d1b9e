// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/draw_all.hpp"
#include "limber/results/history.hpp"

namespace limber::app {

/// A curve in a picture: its name and its data.
struct NamedHistory {
  std::string name;
  const results::History* history;
  /// Peaks of its columns, to be marked, and envelopes; null: none.
  const dynamics::RunRecord* record = nullptr;
};

/// One picture per probe, "probe_NAME.png": its columns, one line per history.
/// All have the columns of the first. A single history's events are marked.
/// @param lines their histories and records must exist until the pictures are
/// drawn
[[nodiscard]] std::vector<results::Picture> list_probe_pictures(
    const std::vector<NamedHistory>& lines,
    const std::filesystem::path& folder);

}  // namespace limber::app
