// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// Robots that were read, by their file and the settings that are of it. To
/// read one costs more than all else of a scene: scenes of one study share it.
using KnownRobots = std::map<std::vector<std::string>, Robot>;

/// The robot of a scenario, or all of its robots as one (join_robots). Adds
/// the velocities of several robots to the joints' starts, since those are of
/// joints then.
/// @param settings are applied to the files first
/// @param known is looked up and added to, without looking at files again
/// @throws InputError with every problem of the files.
[[nodiscard]] Robot read_robots(Scenario& scenario,
                                const std::vector<RobotSetting>& settings,
                                KnownRobots* known = nullptr);

}  // namespace limber::scene
