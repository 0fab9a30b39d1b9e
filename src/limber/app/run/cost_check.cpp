// SPDX-License-Identifier: BSD-3-Clause
#include "limber/app/run/cost_check.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <system_error>

#include "limber/app/run/pace.hpp"
#include "limber/common/errors.hpp"
#include "limber/common/files/scratch_folder.hpp"
#include "limber/dynamics/equations/energy.hpp"
#include "limber/results/results_file.hpp"
#include "limber/runs/probe_columns.hpp"

namespace limber::app {
namespace {

namespace fs = std::filesystem;

ScratchFolder make_scratch() {
  try {
    return ScratchFolder(fs::temp_directory_path() / "limber-check-");
  } catch (const std::system_error& error) {
    throw InputError(
        fmt::format("no temporary folder can be made ({}); set "
                    "TMPDIR",
                    error.code().message()));
  }
}

/// The start, as often as there are outputs.
results::History repeat_start(const scene::BuiltScene& built, int outputs) {
  results::History history;
  history.columns = runs::list_columns(built.probes);
  const std::vector<double> row =
      scene::evaluate_all(built.probes, built.model, built.initial);
  dynamics::SystemState state = built.initial;
  for (int i = 0; i < outputs; ++i) {
    state.t = built.initial.t + i;
    history.times.push_back(state.t);
    history.probe_rows.push_back(row);
    history.states.push_back(state);
    history.energies.push_back(
        dynamics::calc_energy(built.model, built.initial));
  }
  return history;
}

double measure_file(const runs::PicturedScene& scene, int outputs) {
  const ScratchFolder folder = make_scratch();
  const fs::path file = folder.path() / "results.h5";
  results::write_results(file, scene.built.model,
                         repeat_start(scene.built, outputs), &scene.scenery);
  return static_cast<double>(fs::file_size(file));
}

/// Of results.h5 with all outputs, from those of two outputs and many.
std::size_t predict_file(const runs::PicturedScene& scene) {
  constexpr int kMany = 66;
  constexpr int kFew = 2;
  const scene::BuiltScene& built = scene.built;
  const auto outputs = static_cast<double>(built.settings.output_times.size());
  const double least = measure_file(scene, kFew);
  const double each = (measure_file(scene, kMany) - least) / (kMany - kFew);
  const std::size_t columns = runs::list_columns(built.probes).size();
  const std::vector<double> edges = choose_envelope_edges(
      built.initial.t, built.settings.output_times, built.settings.end_time);
  const std::size_t envelopes =
      sizeof(double) * edges.size() * (1 + 2 * columns);
  return static_cast<std::size_t>(least +
                                  std::max(outputs - kFew, 0.0) * each) +
         envelopes;
}

std::size_t find_largest_memory() {
  rusage used = {};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<std::size_t>(used.ru_maxrss) * 1024;
}

}  // namespace

CostCheck check_cost(const runs::PicturedScene& scene) {
  const scene::BuiltScene& built = scene.built;
  CostCheck cost;
  cost.pace = measure_pace(built);
  cost.file_bytes = predict_file(scene);
  cost.memory_bytes = find_largest_memory();
  return cost;
}

}  // namespace limber::app
