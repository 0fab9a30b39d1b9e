// SPDX-License-Identifier: BSD-3-Clause
#include "app/probe_pictures.hpp"

#include <fmt/format.h>

#include "app/event_report.hpp"
#include "app/terminal.hpp"
#include "results/path_step.hpp"
#include "results/pictures.hpp"

namespace limber::app {
namespace {

results::Series make_series(const NamedHistory& line, std::size_t column) {
  results::Series series{line.name, line.history->times, {}, {}};
  if (line.peaks != nullptr && column < line.peaks->size()) {
    series.peak = (*line.peaks)[column];
  }
  for (const std::vector<double>& row : line.history->probe_rows) {
    series.values.push_back(row[column]);
  }
  return series;
}

/// "tip" of the column "tip.ux".
std::string find_probe_name(const std::string& column) {
  return column.substr(0, column.rfind('.'));
}

/// All lines of one column.
results::Panel make_panel(const std::vector<NamedHistory>& lines,
                          std::size_t column) {
  const results::ProbeColumn& what = lines.front().history->columns[column];
  results::Panel panel{fmt::format("{} [{}]", what.name, what.unit), {}};
  for (const NamedHistory& line : lines) {
    panel.series.push_back(make_series(line, column));
  }
  return panel;
}

}  // namespace

void draw_probes(const std::vector<NamedHistory>& lines,
                 const std::filesystem::path& folder) {
  const results::History& history = *lines.front().history;
  const auto& columns = history.columns;
  std::vector<results::Mark> marks;
  if (lines.size() == 1 && !history.times.empty()) {
    marks =
        make_marks(history.events, history.times.front(), history.times.back());
  }
  for (std::size_t first = 0; first < columns.size();) {
    const std::string name = find_probe_name(columns[first].name);
    std::vector<results::Panel> panels;
    for (; first < columns.size(); ++first) {
      if (find_probe_name(columns[first].name) != name) break;
      panels.push_back(make_panel(lines, first));
    }
    const std::string why = results::draw_overlay(
        folder / ("probe_" + results::to_path_step(name) + ".png"), name,
        panels, marks);
    if (why.empty()) continue;
    print_warnings({why});
    return;  // the next would fail alike
  }
}

}  // namespace limber::app
