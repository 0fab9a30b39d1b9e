// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/reports/probe_pictures.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "limber/app/reports/event_report.hpp"
#include "limber/results/path_step.hpp"
#include "limber/results/pictures.hpp"

namespace limber::app {
namespace {

results::Band make_band(const Envelopes& envelopes, std::size_t column) {
  const auto c = static_cast<Eigen::Index>(column);
  const auto least = envelopes.least.col(c);
  const auto most = envelopes.most.col(c);
  return {envelopes.edges,
          {least.begin(), least.end()},
          {most.begin(), most.end()}};
}

results::Series make_series(const NamedHistory& line, std::size_t column) {
  results::Series series{line.name, {}, {}};
  const results::History& history = *line.history;
  for (const std::size_t i :
       results::list_drawn_outputs(history.times.size())) {
    series.times.push_back(history.times[i]);
    series.values.push_back(history.probe_rows[i][column]);
  }
  const double error = history.columns[column].error;
  if (!std::isnan(error)) series.error = error;
  const dynamics::RunRecord* record = line.record;
  if (record == nullptr || column >= record->peaks.size()) return series;
  series.peak = record->peaks[column];
  if (record->envelopes.is_empty()) return series;
  results::Band band = make_band(record->envelopes, column);
  if (exceeds(band, series.times, series.values)) {
    series.band = std::move(band);
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
  std::string label = fmt::format("{} [{}]", what.name, what.unit);
  if (!std::isnan(what.error)) label += fmt::format(" ± {:.2g}", what.error);
  results::Panel panel{label, {}};
  for (const NamedHistory& line : lines) {
    panel.series.push_back(make_series(line, column));
  }
  return panel;
}

}  // namespace

std::vector<results::GnuplotScript> write_probe_charts(
    const std::vector<NamedHistory>& lines,
    const std::filesystem::path& folder) {
  const results::History& history = *lines.front().history;
  const auto& columns = history.columns;
  std::vector<results::Mark> marks;
  if (lines.size() == 1 && !history.times.empty()) {
    marks =
        make_marks(history.events, history.times.front(), history.times.back());
  }
  std::vector<results::GnuplotScript> charts;
  for (std::size_t first = 0; first < columns.size();) {
    const std::string name = find_probe_name(columns[first].name);
    std::size_t end = first;
    while (end < columns.size() && find_probe_name(columns[end].name) == name) {
      ++end;
    }
    std::vector<results::Panel> panels;
    for (std::size_t column = first; column < end; ++column) {
      panels.push_back(make_panel(lines, column));
    }
    charts.push_back(results::write_overlay(
        folder / ("probe_" + results::to_path_step(name) + ".png"), name,
        panels, marks));
    first = end;
  }
  return charts;
}

}  // namespace limber::app
