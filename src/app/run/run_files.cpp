// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "app/probe_pictures.hpp"
#include "app/run_scene.hpp"
#include "app/terminal.hpp"
#include "app/text_file.hpp"
#include "dynamics/energy_verdict.hpp"
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

/// What a picture's title adds if energy was made or lost.
std::string describe_open(const Run& run) {
  const dynamics::EnergyRecord& energy = run.record.energy;
  const double share = dynamics::find_open_share(energy);
  if (!(share > dynamics::kToldDrift)) return "";
  return fmt::format(" ({:.2g} % open at {:.4g} s, most in {})", 100.0 * share,
                     energy.drift.time, energy.place);
}

void draw_run(const Run& run, const std::filesystem::path& folder) {
  const std::string& name = run.scene.scenario.name;
  warn(results::draw_energy(folder / "energy.png", name + describe_open(run),
                            run.history));
  warn(results::draw_scene(
      folder / "scene.png", name, run.built.model,
      {run.history.states.front(), run.history.states.back()}));
  draw_probes({{std::string(to_string(run.scene.scenario.fidelity)),
                &run.history, &run.record.peaks}},
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

}  // namespace limber::app
