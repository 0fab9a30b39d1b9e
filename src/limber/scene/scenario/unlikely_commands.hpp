// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Questions about drives and controllers: angles that are commanded beyond a
/// full turn and the joint's stops, or more than 1 rad beyond a stop where as
/// many degrees are within it, phases beyond one, a controller
/// whose period is longer than the run, and limits of a controller above those
/// of the drive that follows it.
[[nodiscard]] std::vector<std::string> question_commands(
    const Scenario& scenario, const Robot& robot);

}  // namespace limber::scene
