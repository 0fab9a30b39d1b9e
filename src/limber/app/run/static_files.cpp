// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/static_files.hpp"

#include <cmath>

#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/reports/static_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/probes_csv.hpp"
#include "limber/results/results_file.hpp"
#include "limber/results/xdmf.hpp"

namespace limber::app {
namespace {

/// Magnifies small displacements to be visible.
double find_exaggeration(const dynamics::Equilibrium& found) {
  constexpr double kSeen = 0.1;  // of the extent
  const double fraction = found.distance / found.extent;
  if (fraction == 0.0 || fraction > 0.2 * kSeen) return 1.0;
  return std::pow(10.0, std::floor(std::log10(kSeen / fraction)));
}

void draw(const runs::StaticRun& run, const std::filesystem::path& file) {
  const std::string why_none = results::draw_displacement(
      file, run.scene.scenario.name, run.built.model, run.built.initial,
      run.found.state, find_exaggeration(run.found), run.scenery);
  if (!why_none.empty()) print_warnings({why_none});
}

}  // namespace

Json summarize(const runs::StaticRun& run) {
  Json json = Json::object();
  json["scenario"] = run.scene.scenario.file.string();
  json["method"] = dynamics::equilibrium_method_names().at(
      static_cast<std::size_t>(run.method));
  json["load_steps"] = run.found.load_steps;
  json["newton_iterations"] = run.found.newton_iterations;
  json["relaxation_steps"] = run.found.relaxation_steps;
  json.update(to_json(run.report));
  Json probes = Json::object();
  for (std::size_t i = 0; i < run.history.columns.size(); ++i) {
    probes[run.history.columns[i].name] =
        Json{{"value", run.history.probe_rows[0][i]},
             {"unit", run.history.columns[i].unit}};
  }
  json["probes"] = probes;
  if (run.scene.scenario.output.stress) json["stress"] = to_json(run.stress);
  json["notes"] = run.built.notes;
  json["warnings"] = run.warnings;
  return json;
}

void write_static(const runs::StaticRun& run,
                  const std::filesystem::path& folder, bool xdmf) {
  results::write_results(folder / "results.h5", run.built.model, run.history,
                         &run.scenery);
  results::write_probes_csv(folder / "probes.csv", run.history);
  write_text(folder / "summary.json", to_text(summarize(run)));
  if (xdmf) {
    print_warnings(results::write_xdmf(folder / "motion.xdmf", run.built.model,
                                       run.history));
  }
  if (run.scene.scenario.output.pictures) draw(run, folder / "equilibrium.png");
}

}  // namespace limber::app
