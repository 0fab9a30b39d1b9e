// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <memory>

#include "app/commands.hpp"
#include "app/run_scene.hpp"
#include "dynamics/fidelity.hpp"

namespace limber::app {
namespace {

struct Options {
  std::string scenario;
  std::string fidelity;
  std::string out;
  std::string cache;
  bool json = false;
  bool xdmf = false;
};

std::filesystem::path find_folder(const Options& options,
                                  const scene::Scenario& scenario) {
  if (!options.out.empty()) return options.out;
  if (!scenario.output.folder.empty()) return scenario.output.folder;
  return std::filesystem::path("out") / scenario.name;
}

void print_text(const Run& run, const std::filesystem::path& folder) {
  fmt::print("{} bodies, {} modes, {} couplers\n",
             run.built.model.bodies.size(), run.built.model.modal_count,
             run.built.model.couplers.size());
  fmt::print("offline {:.3g} s ({} reduced, {} from the cache)\n",
             run.built.seconds_offline, run.built.bodies_reduced,
             run.built.bodies_cached);
  fmt::print("online  {:.3g} s, {} steps, {} Newton iterations\n",
             run.statistics.seconds, run.statistics.steps,
             run.statistics.newton_iterations);
  if (!run.history.energies.empty()) {
    const dynamics::EnergyBalance& last = run.history.energies.back();
    fmt::print("energy  {:.6g} J, work {:.6g} J, dissipated {:.6g} J\n",
               last.total(), last.work, last.dissipated);
  }
  for (std::size_t i = 0; i < run.history.columns.size(); ++i) {
    if (run.history.probe_rows.empty()) break;
    double peak = 0.0;
    for (const auto& row : run.history.probe_rows) {
      peak = std::max(peak, std::abs(row[i]));
    }
    fmt::print("{:<28} final {:13.6g}  peak {:13.6g} {}\n",
               run.history.columns[i].name, run.history.probe_rows.back()[i],
               peak, run.history.columns[i].unit);
  }
  fmt::print("results in {}\n", folder.string());
}

void run(const Options& options) {
  scene::Overrides overrides;
  if (!options.fidelity.empty()) {
    overrides.fidelity = dynamics::parse_fidelity(options.fidelity);
  }
  const scene::Scene scene = scene::load_scene(options.scenario, overrides);
  const std::filesystem::path folder = find_folder(options, scene.scenario);
  check_output_folder(folder);
  const Run result = run_scene(scene, options.cache);
  write_run(result, folder, options.xdmf || scene.scenario.output.xdmf);
  if (result.failure) std::rethrow_exception(result.failure);
  if (options.json) {
    Json json = summarize(result);
    json["folder"] = folder.string();
    fmt::print("{}\n", to_text(json));
  } else {
    print_text(result, folder);
  }
}

}  // namespace

void add_run(CLI::App& app, Action& action) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("run", "Simulate a scenario");
  command->add_option("scenario", options->scenario, "Scenario file (TOML)")
      ->required();
  command->add_option("--fidelity", options->fidelity,
                      "Level of every flexible link: rigid, uncoupled, "
                      "one-way, coupled");
  command->add_option("--out", options->out,
                      "Results folder (default: out/<scenario name>)");
  command->add_option("--cache", options->cache, "Folder of reduced bodies");
  command->add_flag("--json", options->json, "Print one JSON object");
  command->add_flag("--xdmf", options->xdmf, "Write files for ParaView");
  command->callback(
      [&action, options] { action = [options] { run(*options); }; });
}

}  // namespace limber::app
