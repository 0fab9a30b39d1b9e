// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/dynamics/integrators/integrator.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// The integrator selected by `settings`.
/// @param model must outlive the integrator
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(
    const SystemModel& model, const SimulationSettings& settings);

}  // namespace limber::dynamics
