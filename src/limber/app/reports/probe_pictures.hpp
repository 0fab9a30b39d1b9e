// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/dynamics/simulation/run_record.hpp"
#include "limber/results/gnuplot.hpp"
#include "limber/results/history.hpp"

namespace limber::app {

/// A curve in a picture: its name and its data.
struct NamedHistory {
  std::string name;
  const results::History* history;
  /// Peaks of its columns, to be marked, and envelopes; null: none.
  const dynamics::RunRecord* record = nullptr;
};

/// One chart per probe, "probe_NAME.png": its columns, one line per history.
/// All have the columns of the first. A single history's events are marked.
[[nodiscard]] std::vector<results::GnuplotScript> write_probe_charts(
    const std::vector<NamedHistory>& lines,
    const std::filesystem::path& folder);

}  // namespace limber::app
