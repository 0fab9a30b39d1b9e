// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scene/robot.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// Checks a scenario against its robot: links that exist, places that suit
/// their link, levels only for flexible links.
/// @throws InputError with every problem found.
void check_scenario(const Scenario& scenario, const Robot& robot);

}  // namespace limber::scene
