// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"
#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// Robots that were read, by their file and its settings. Reading one costs
/// more than the rest of a scene, so the scenes of a study share it.
using KnownRobots = std::map<std::vector<std::string>, Robot>;

/// The robot of a scenario, fixed to the world if its base is (fix_base), or
/// all of its robots as one (join_robots). With several robots their velocities
/// become starts of joints.
/// @param settings are applied to the files first
/// @param known robots read before, which are not read again; gets new ones
/// @throws InputError with every problem of the files.
[[nodiscard]] Robot read_robots(Scenario& scenario,
                                const std::vector<RobotSetting>& settings,
                                KnownRobots* known = nullptr);

/// Joints that a scenario drives, starts or measures.
[[nodiscard]] std::set<std::string> find_used_joints(const Scenario& scenario);

}  // namespace limber::scene
