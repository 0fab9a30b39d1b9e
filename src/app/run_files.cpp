// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "app/comparison.hpp"
#include "app/run_scene.hpp"
#include "app/terminal.hpp"
#include "app/text_file.hpp"
#include "results/path_step.hpp"
#include "results/pictures.hpp"
#include "results/probes_csv.hpp"
#include "results/results_file.hpp"
#include "results/xdmf.hpp"

namespace limber::app {
namespace {

/// A picture that cannot be drawn costs a warning, not the run.
void warn(const std::string& why_none) {
  if (!why_none.empty()) print_warnings({why_none});
}

results::Series make_series(const std::string& name,
                            const results::History& history,
                            std::size_t column) {
  results::Series series{name, history.times, {}};
  for (const std::vector<double>& row : history.probe_rows) {
    series.values.push_back(row[column]);
  }
  return series;
}

/// A picture a probe: its three columns, a line a run.
void draw_probes(const std::vector<std::string>& names,
                 const std::vector<const Run*>& runs,
                 const std::filesystem::path& folder) {
  const Run& first = *runs.front();
  for (std::size_t p = 0; p < first.built.probes.size(); ++p) {
    std::vector<results::Panel> panels;
    for (std::size_t c = 3 * p; c < 3 * p + 3; ++c) {
      const results::ProbeColumn& column = first.history.columns[c];
      results::Panel panel{fmt::format("{} [{}]", column.name, column.unit),
                           {}};
      for (std::size_t r = 0; r < runs.size(); ++r) {
        panel.series.push_back(make_series(names[r], runs[r]->history, c));
      }
      panels.push_back(std::move(panel));
    }
    const std::string& name = first.built.probes[p].name;
    const std::string why = results::draw_overlay(
        folder / ("probe_" + results::to_path_step(name) + ".png"), name,
        panels);
    warn(why);
    if (!why.empty()) return;  // the next would fail alike
  }
}

void draw_run(const Run& run, const std::filesystem::path& folder) {
  const std::string& name = run.scene.scenario.name;
  warn(results::draw_energy(folder / "energy.png", name, run.history));
  warn(results::draw_scene(
      folder / "scene.png", name, run.built.model,
      {run.history.states.front(), run.history.states.back()}, 1.0));
  draw_probes({std::string(to_string(run.scene.scenario.fidelity))}, {&run},
              folder);
}

}  // namespace

void write_run(const Run& run, const std::filesystem::path& folder, bool xdmf) {
  results::write_results(folder / "results.h5", run.built.model, run.history);
  results::write_probes_csv(folder / "probes.csv", run.history);
  write_text(folder / "summary.json", to_text(summarize(run)));
  if (xdmf) {
    results::write_xdmf(folder / "motion.xdmf", run.built.model, run.history);
  }
  if (run.scene.scenario.output.pictures && !run.history.states.empty()) {
    draw_run(run, folder);
  }
}

void write_comparison(const Comparison& comparison,
                      const std::filesystem::path& folder) {
  write_text(folder / "comparison.json", to_text(to_json(comparison)));
  if (!comparison.runs.back().scene.scenario.output.pictures) return;
  std::vector<const Run*> runs;
  for (const Run& run : comparison.runs) runs.push_back(&run);
  draw_probes(comparison.levels, runs, folder);
}

}  // namespace limber::app
