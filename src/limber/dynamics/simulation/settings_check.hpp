// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/integrators/simulation_settings.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Checks the arguments of a simulation.
/// @throws InputError for settings outside their range, or excluded by the
/// integrator or the model; ContractError for a state of another model.
void check_settings(const SystemModel& model, const SystemState& state,
                    const SimulationSettings& settings);

/// The first controller with hidden memory; null if none has any.
[[nodiscard]] const ControllerModel* find_hidden_memory(
    const SystemModel& model);

/// @param why controllers must be repeatable: the end of the message's sentence
/// @throws InputError for a controller with hidden memory.
void refuse_hidden_memory(const SystemModel& model, const std::string& why);

}  // namespace limber::dynamics
