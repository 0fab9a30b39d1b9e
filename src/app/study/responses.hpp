// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/app/run/run_scene.hpp"
#include "limber/app/study/study.hpp"

namespace limber::app {

/// A number for each response; none where there is none, as a restitution
/// while bodies still touch, or where it is not finite.
using ResponseValues = std::vector<std::optional<double>>;

/// @throws InputError naming every response that is not there in runs of a
/// scene: an unknown column, contact or figure, or a wrong formula.
void check_responses(const Study& study, const scene::Scene& scene,
                     const scene::BuiltScene& built);

/// Whether a response needs the judgement of levels, which costs time.
[[nodiscard]] bool needs_levels(const Study& study);

/// All responses but formulas.
/// @throws InputError for a figure that the run's summary does not have
[[nodiscard]] ResponseValues evaluate_run(const Study& study, const Run& run);

/// Adds those. Not in two threads at a time.
void evaluate_formulas(const Study& study,
                       const std::vector<std::string>& factors,
                       ResponseValues& values);

}  // namespace limber::app
