// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/simulation/simulation.hpp"
#include "limber/scene/text/toml_table.hpp"

namespace limber::scene {

/// Tolerance of a scenario with neither a step nor a tolerance, until
/// build_system() chooses one [m].
inline constexpr double kToleranceToChoose = kInfinity;

/// Reads a scenario's [time] table.
/// @param warnings gets a step that is longer than the output interval
[[nodiscard]] dynamics::SimulationSettings read_time_settings(
    TomlTable& table, std::vector<std::string>& warnings);

}  // namespace limber::scene
