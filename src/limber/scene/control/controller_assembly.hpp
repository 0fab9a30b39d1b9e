// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/system/system_builder.hpp"
#include "limber/scene/probes/probe.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Adds the input of each controller, before loads and drives that follow it.
void add_inputs(const Scenario& scenario, dynamics::SystemBuilder& builder);

/// Index of a controller, and of its input. @throws ContractError if it does
/// not exist.
[[nodiscard]] int find_controller(const Scenario& scenario,
                                  const std::string& name);

/// The controllers, which measure probes, each of the input of its index.
/// @param probes of the system, with their starts
/// @throws InputError naming the controller if a probe has no such column.
[[nodiscard]] std::vector<dynamics::ControllerModel> make_controllers(
    const Scenario& scenario, const std::vector<Probe>& probes);

}  // namespace limber::scene
