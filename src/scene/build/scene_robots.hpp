// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// The robot of a scenario, or all of its robots as one (join_robots). Adds
/// the velocities of several robots to the joints' starts, since those are of
/// joints then.
/// @param settings are applied to the files first
/// @throws InputError with every problem of the files.
[[nodiscard]] Robot read_robots(Scenario& scenario,
                                const std::vector<RobotSetting>& settings);

}  // namespace limber::scene
