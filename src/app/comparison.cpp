// SPDX-License-Identifier: BSD-3-Clause
#include "app/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace limber::app {

Difference find_difference(const results::History& history,
                           const results::History& reference,
                           std::size_t column) {
  const std::size_t count =
      std::min(history.probe_rows.size(), reference.probe_rows.size());
  Difference difference;
  for (std::size_t i = 0; i < count; ++i) {
    const double d =
        history.probe_rows[i][column] - reference.probe_rows[i][column];
    difference.rms += d * d;
    difference.max = std::max(difference.max, std::abs(d));
  }
  if (count > 0) {
    difference.rms = std::sqrt(difference.rms / static_cast<double>(count));
  }
  return difference;
}

Json to_json(const Comparison& comparison) {
  const results::History& reference = comparison.runs.back().history;
  Json levels = Json::array();
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const Run& run = comparison.runs[i];
    Json probes = Json::object();
    for (std::size_t c = 0; c < reference.columns.size(); ++c) {
      const Difference d = find_difference(run.history, reference, c);
      probes[reference.columns[c].name] = Json{
          {"rms", d.rms}, {"max", d.max}, {"unit", reference.columns[c].unit}};
    }
    levels.push_back(
        Json{{"fidelity", comparison.levels[i]},
             {"steps", run.statistics.steps},
             {"newton_iterations", run.statistics.newton_iterations},
             {"seconds_offline", run.built.seconds_offline},
             {"seconds_online", run.statistics.seconds},
             {"difference", probes}});
  }
  return Json{{"scenario", comparison.runs.back().scene.scenario.file.string()},
              {"reference", comparison.levels.back()},
              {"levels", levels}};
}

std::string to_text(const Comparison& comparison) {
  const results::History& reference = comparison.runs.back().history;
  std::string text = fmt::format("{:<28}", "RMS (max) difference");
  for (const std::string& level : comparison.levels) {
    text += fmt::format(" {:>22}", level);
  }
  for (std::size_t c = 0; c < reference.columns.size(); ++c) {
    text += fmt::format("\n{:<28}", reference.columns[c].name + " [" +
                                        reference.columns[c].unit + "]");
    for (const Run& run : comparison.runs) {
      const Difference d = find_difference(run.history, reference, c);
      text +=
          fmt::format(" {:>22}", fmt::format("{:.3g} ({:.3g})", d.rms, d.max));
    }
  }
  text += fmt::format("\n{:<28}", "online [s]");
  for (const Run& run : comparison.runs) {
    text += fmt::format(" {:>22.3g}", run.statistics.seconds);
  }
  return text + "\n";
}

}  // namespace limber::app
