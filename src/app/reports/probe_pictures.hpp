// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/followed.hpp"
#include "results/history.hpp"

namespace limber::app {

/// A line in a picture: its name and what it follows.
struct NamedHistory {
  std::string name;
  const results::History* history;
  /// Of its columns, to be marked; null: none.
  const std::vector<dynamics::Extreme>* peaks = nullptr;
};

/// A picture a probe, "probe_NAME.png": its columns, a line a history. All have
/// the columns of the first. A single history's events are marked. What cannot
/// be drawn is a warning.
void draw_probes(const std::vector<NamedHistory>& lines,
                 const std::filesystem::path& folder);

}  // namespace limber::app
