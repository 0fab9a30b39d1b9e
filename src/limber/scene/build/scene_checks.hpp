// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Checks a scenario against its robot: links exist, places fit their link,
/// only flexible links have levels, names of added bodies are unique, and
/// contacts name existing bodies.
/// @param robot with the projectiles
/// @throws InputError with every problem found.
void check_scenario(const Scenario& scenario, const Robot& robot);

}  // namespace limber::scene
