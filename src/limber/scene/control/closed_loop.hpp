// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/dynamics/analysis/sampled_loop.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/scene/control/linear_scene.hpp"

namespace limber::scene {

/// A scene's controllers around its linear model.
struct ClosedLoop {
  std::unique_ptr<const dynamics::LinearModel> plant;  ///< see linearise()
  std::vector<dynamics::LoopController> controllers;   ///< all, in their order
};

/// @throws InputError naming a controller that is a function, or measures
/// something without a linear model.
[[nodiscard]] ClosedLoop find_closed_loop(const dynamics::SystemModel& model,
                                          const LinearScene& linear);

/// Which controllers an instability is of, its frequency and growth, and a
/// period at which the loop is stable, if there is one.
[[nodiscard]] std::string describe_instability(
    const dynamics::SystemModel& model, const ClosedLoop& loop,
    const dynamics::SampledLoop::Instability& found,
    const Progress& progress = {});

/// The controllers whose sampled loop is unstable about a state, with a period
/// at which it is stable, if there is one; or that the steps make it vibrate,
/// with a shorter one: a warning, or nothing.
///
/// Limits     linear, without dry friction, within the outputs' limits; nothing
///            for bodies at level full, bodies that touch, controllers that are
///            functions, models of more than 600 states, and motion that does
///            not grow tenfold within the run; steps are those of
///            generalized-alpha or implicit Euler without a tolerance
[[nodiscard]] std::optional<std::string> describe_unstable_loop(
    const Scenario& scenario, const dynamics::SystemModel& model,
    const dynamics::SystemState& state, const std::vector<Probe>& probes,
    const dynamics::SimulationSettings& settings,
    const Progress& progress = {});

}  // namespace limber::scene
