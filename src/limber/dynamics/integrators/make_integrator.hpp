// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "limber/dynamics/integrators/integrator.hpp"
#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/system_model.hpp"

namespace limber::dynamics {

/// Whether steps in impacts are those of the energy-conserving scheme
/// (ImpactIntegrator): of implicit schemes, without a tolerance, for which each
/// step needs an estimate of its error, and without bodies at level `full`.
[[nodiscard]] bool conserves_impacts(const SystemModel& model,
                                     const SimulationSettings& settings);

/// The integrator selected by `settings`.
/// @param model must outlive the integrator
[[nodiscard]] std::unique_ptr<Integrator> make_integrator(
    const SystemModel& model, const SimulationSettings& settings);

}  // namespace limber::dynamics
