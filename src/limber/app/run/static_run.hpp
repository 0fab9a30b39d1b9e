// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limber/app/console/json.hpp"
#include "limber/app/reports/static_report.hpp"
#include "limber/app/reports/stress_report.hpp"
#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::app {

/// An equilibrium as a run with one state.
struct StaticRun {
  scene::Scene scene;
  scene::BuiltScene built;  ///< its initial state is the start
  results::Scenery scenery;
  dynamics::EquilibriumMethod method = dynamics::EquilibriumMethod::newton;
  dynamics::Equilibrium found;
  results::History history;
  StaticReport report;
  std::vector<StressPeak> stress;  ///< of the equilibrium
  std::vector<std::string> warnings;
};

/// @param cache empty for the default one
/// @throws InputError if nothing acts at the start; both errors as
/// scene::build_system and dynamics::find_equilibrium.
[[nodiscard]] StaticRun find_static(const scene::Scene& scene,
                                    dynamics::EquilibriumMethod method,
                                    const std::filesystem::path& cache,
                                    const Progress& progress);

/// For summary.json and --json.
[[nodiscard]] Json summarize(const StaticRun& run);

/// Writes results.h5, probes.csv, summary.json and files by request.
void write_static(const StaticRun& run, const std::filesystem::path& folder,
                  bool xdmf);

}  // namespace limber::app
