// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>

#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/balanced_truncation.hpp"
#include "limber/results/linear_model_file.hpp"
#include "limber/runs/reductions.hpp"
#include "limber/scene/build/scene.hpp"
#include "limber/scene/control/linear_scene.hpp"

namespace limber::runs {

/// States of a scene about which it is linearised.
enum class Reference { start, equilibrium };

/// Request for a linear model of a scene.
struct LinearRequest {
  /// A reference, or the state of the scene's run at a time [s].
  std::variant<Reference, double> at = Reference::start;
  scene::LinearSelection selection = {};
  int states = 0;  ///< after balanced truncation; 0: all, without it
  /// With the controllers, as a discrete model (dynamics::SampledLoop), which
  /// has all inputs, outputs and states.
  bool closes_loops = false;
};

/// "start", "equilibrium", or a time [s]. @throws InputError for another text.
[[nodiscard]] std::variant<Reference, double> parse_reference(
    const std::string& text);

/// A linear model of a scene.
struct LinearRun {
  scene::LinearScene linear;  ///< with all states
  std::optional<dynamics::TruncatedModel> truncated;
  results::LinearRecord record;    ///< the requested model
  std::vector<std::string> notes;  ///< as scene::BuiltScene
};

/// @throws InputError for a time outside of the run; as scene::build_system,
/// dynamics::find_equilibrium, dynamics::simulate, scene::linearise and
/// dynamics::truncate_balanced.
[[nodiscard]] LinearRun linearise_scene(const scene::Scene& scene,
                                        const LinearRequest& request,
                                        const Reductions& reductions,
                                        const Progress& progress);

}  // namespace limber::runs
