// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "limber/app/console/interruption.hpp"
#include "limber/app/console/terminal.hpp"
#include "limber/app/reports/contact_report.hpp"
#include "limber/app/reports/error_report.hpp"
#include "limber/app/reports/event_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/app/run/run_scene.hpp"
#include "limber/dynamics/simulation/interrupted.hpp"
#include "limber/results/energy_error.hpp"
#include "limber/scene/scenario/time_settings_reader.hpp"

namespace limber::app {
namespace {

/// Error of the energy energy relative to the throughput.
std::string describe_drift(const runs::Run& run) {
  const results::EnergyError energy = results::find_energy_error(run.history);
  const std::optional<double> relative = energy.relative();
  if (!relative) return "";
  const dynamics::EnergyDrift& worst = run.record.energy.worst;
  std::string text = fmt::format("; drift {:.2g} J, {:.1e} of the throughput",
                                 energy.drift, *relative);
  if (!(worst.throughput > 0.0)) return text;
  return text + fmt::format(", at most {:.1e} at {:.4g} s",
                            std::abs(worst.drift.value) / worst.throughput,
                            worst.drift.time);
}

void print_probes(const results::History& history,
                  const std::vector<dynamics::Extreme>& peaks) {
  if (history.probe_rows.empty() || peaks.empty()) return;
  for (std::size_t i = 0; i < history.columns.size(); ++i) {
    fmt::print("{:<28} final {:13.6g}  peak {:13.6g} {} at {:.6g} s\n",
               history.columns[i].name, history.probe_rows.back()[i],
               peaks[i].value, history.columns[i].unit, peaks[i].time);
  }
}

void print_tolerance(const runs::Run& run) {
  const double tolerance = run.built.settings.tolerance;
  const bool is_chosen =
      run.scene.scenario.settings.tolerance == scene::kToleranceToChoose;
  const std::string chosen =
      is_chosen ? ", 1e-4 of the smallest group's largest body, as no step is "
                  "given"
                : "";
  if (run.statistics.passes > 1) {
    fmt::print(
        "error   {:.2g} m at most, estimated from {} passes; tolerance {:.3g} "
        "m{}\n",
        run.statistics.estimated_error, run.statistics.passes, tolerance,
        chosen);
    return;
  }
  fmt::print("error   shared by all steps of one pass: tolerance {:.3g} m{}\n",
             tolerance, chosen);
}

void print_text(const runs::Run& run, const std::filesystem::path& folder) {
  fmt::print("{} bodies, {} modes ({} in closed form), {} couplers\n",
             run.built.model.bodies.size(), run.built.model.modal_count,
             run.statistics.exact_modes, run.built.model.couplers.size());
  for (const dynamics::BodyModel& body : run.built.model.bodies) {
    if (!body.reduced || !body.reduced->selection) continue;
    fmt::print("'{}': {}\n", body.name, summarize(*body.reduced->selection));
  }
  for (const flexbody::PieceCheck& check : run.built.piece_checks) {
    fmt::print("'{}': its {} pieces {}\n", check.link, check.count,
               describe_largest(check));
  }
  fmt::print("offline {:.3g} s ({} reduced, {} from the cache)\n",
             run.built.seconds_offline, run.built.bodies_reduced,
             run.built.bodies_cached);
  fmt::print("online  {:.3g} s, {} steps, {} Newton iterations\n",
             run.statistics.seconds, run.statistics.steps,
             run.statistics.newton_iterations);
  if (run.statistics.passes > 0) print_tolerance(run);
  if (run.statistics.halved_steps > 0) {
    fmt::print("        steps were halved {} times\n",
               run.statistics.halved_steps);
  }
  if (!run.history.energies.empty()) {
    const dynamics::EnergyBalance& last = run.history.energies.back();
    fmt::print("energy  {:.6g} J, work {:.6g} J, dissipated {:.6g} J{}\n",
               last.total(), last.work, last.dissipated, describe_drift(run));
  }
  fmt::print("{}", to_text(run.history.events));
  fmt::print("{}", to_text(run.record.contacts));
  print_probes(run.history, run.record.peaks);
  if (run.errors) fmt::print("{}", to_text(*run.errors));
  fmt::print("{}", to_text(runs::find_stress_peaks(run.built, run.history,
                                                   run.record)));
  fmt::print("results in {}\n", folder.string());
}

void raise_failure(const runs::Run& run, const std::filesystem::path& folder) {
  try {
    std::rethrow_exception(run.failure);
  } catch (const dynamics::Interrupted& end) {
    throw dynamics::Interrupted(
        fmt::format("{} by {}; results up to there are in '{}'{}", end.what(),
                    name_signal(find_received_signal()), folder.string(),
                    std::filesystem::exists(folder / "checkpoint.bin")
                        ? "; continue with --resume"
                        : ""));
  }
}

// Prints the report completely before pictures are drawn. Errors of the stream
// are reported at the end of the command.
void report_run(const runs::Run& run, const std::filesystem::path& folder,
                bool json) {
  if (json) {
    Json summary = summarize(run);
    summary["folder"] = folder.string();
    fmt::print("{}\n", to_text(summary));
  } else {
    print_text(run, folder);
  }
  static_cast<void>(std::fflush(stdout));
}

}  // namespace

void finish_run(const runs::Run& run, const OutputFolder& folder, bool json) {
  print_warnings(runs::find_level_warnings(run.levels));
  if (!run.failure) report_run(run, folder.path(), json);
  if (has_pictures(run)) {
    folder.add(
        [&](const std::filesystem::path& place) { draw_run(run, place); });
  }
  if (run.failure) raise_failure(run, folder.path());
}

}  // namespace limber::app
