// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Reads a scenario's [time] table.
[[nodiscard]] dynamics::SimulationSettings read_time_settings(TomlTable& table);

}  // namespace limber::scene
