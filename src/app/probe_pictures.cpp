// SPDX-License-Identifier: BSD-3-Clause
#include "app/probe_pictures.hpp"

#include <fmt/format.h>

#include "app/terminal.hpp"
#include "results/path_step.hpp"
#include "results/pictures.hpp"

namespace limber::app {
namespace {

results::Series make_series(const NamedHistory& line, std::size_t column) {
  results::Series series{line.name, line.history->times, {}};
  for (const std::vector<double>& row : line.history->probe_rows) {
    series.values.push_back(row[column]);
  }
  return series;
}

/// "tip" of the column "tip.ux".
std::string find_probe_name(const std::string& column) {
  return column.substr(0, column.rfind('.'));
}

}  // namespace

void draw_probes(const std::vector<NamedHistory>& lines,
                 const std::filesystem::path& folder) {
  const auto& columns = lines.front().history->columns;
  for (std::size_t first = 0; first + 3 <= columns.size(); first += 3) {
    std::vector<results::Panel> panels;
    for (std::size_t c = first; c < first + 3; ++c) {
      results::Panel panel{
          fmt::format("{} [{}]", columns[c].name, columns[c].unit), {}};
      for (const NamedHistory& line : lines) {
        panel.series.push_back(make_series(line, c));
      }
      panels.push_back(std::move(panel));
    }
    const std::string name = find_probe_name(columns[first].name);
    const std::string why = results::draw_overlay(
        folder / ("probe_" + results::to_path_step(name) + ".png"), name,
        panels);
    if (why.empty()) continue;
    print_warnings({why});
    return;  // the next would fail alike
  }
}

}  // namespace limber::app
