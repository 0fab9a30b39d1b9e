// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Questions about values of a scene that hardly anyone means: angles
/// (unlikely_angles.hpp), gravity above 100 m/s^2, materials, sizes and masses
/// (unlikely_sizes.hpp) and commands (unlikely_commands.hpp).
[[nodiscard]] std::vector<std::string> question_scene(const Scenario& scenario,
                                                      const Robot& robot);

}  // namespace limber::scene
