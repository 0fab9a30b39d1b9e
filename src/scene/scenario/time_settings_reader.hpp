// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads a scenario's [time] table.
/// @param warnings gets a step that is longer than the output interval
[[nodiscard]] dynamics::SimulationSettings read_time_settings(
    TomlTable& table, std::vector<std::string>& warnings);

}  // namespace limber::scene
