// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/equilibrium.hpp"
#include "limber/results/history.hpp"
#include "limber/results/scenery.hpp"
#include "limber/runs/analyses/static_report.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/runs/stress_peaks.hpp"
#include "limber/scene/build/build_system.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::runs {

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

/// @throws InputError if nothing acts at the start; both errors as
/// scene::build_system and dynamics::find_equilibrium.
[[nodiscard]] StaticRun find_static(const scene::Scene& scene,
                                    dynamics::EquilibriumMethod method,
                                    const Reductions& reductions,
                                    const Progress& progress);

}  // namespace limber::runs
