// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <utility>

#include "limber/app/console/terminal.hpp"
#include "limber/app/console/text_file.hpp"
#include "limber/app/reports/probe_pictures.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/dynamics/monitors/energy_verdict.hpp"
#include "limber/results/draw_all.hpp"
#include "limber/results/pictures.hpp"
#include "limber/results/probes_csv.hpp"
#include "limber/results/results_file.hpp"
#include "limber/results/xdmf.hpp"

namespace limber::app {
namespace {

/// Addition to a picture's title if energy was gained or lost.
std::string describe_open(const runs::Run& run) {
  const dynamics::EnergyDrift& energy = run.record.energy.worst;
  const double fraction = dynamics::find_unbalanced_fraction(energy);
  if (!(fraction > dynamics::kReportedDrift)) return "";
  return fmt::format(" (energy error {:.2g} % at {:.4g} s, most in {})",
                     100.0 * fraction, energy.drift.time, energy.place);
}

}  // namespace

void write_run(const runs::Run& run, const std::filesystem::path& folder,
               bool xdmf) {
  results::write_results(folder / "results.h5", run.built.model, run.history,
                         &run.scenery, &run.record);
  results::write_probes_csv(folder / "probes.csv", run.history);
  if (!run.record.peaks.empty()) {
    results::write_peaks_csv(folder / "peaks.csv", run.history,
                             run.record.peaks);
    results::write_envelopes_csv(folder / "envelopes.csv", run.history,
                                 run.record.envelopes);
  }
  write_text(folder / "summary.json", to_text(summarize(run)));
  if (xdmf) {
    print_warnings(results::write_xdmf(folder / "motion.xdmf", run.built.model,
                                       run.history));
  }
}

bool has_pictures(const runs::Run& run) {
  return run.scene.scenario.output.pictures && !run.history.states.empty();
}

void draw_run(const runs::Run& run, const std::filesystem::path& folder) {
  const std::string& name = run.scene.scenario.name;
  const std::string level(to_string(run.scene.scenario.fidelity));
  // The slowest one first.
  std::vector<results::Picture> pictures = {[&] {
    return results::draw_scene(folder / "scene.png", name, run.built.model,
                               run.history, run.scenery);
  }};
  std::vector<results::GnuplotScript> charts =
      write_probe_charts({{level, &run.history, &run.record}}, folder);
  charts.push_back(results::write_energy(
      folder / "energy.png", name + describe_open(run), run.history));
  results::add_charts(std::move(charts), pictures);
  print_warnings(results::draw_all(pictures));
}

}  // namespace limber::app
