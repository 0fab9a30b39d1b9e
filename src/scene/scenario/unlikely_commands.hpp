// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Whether all coordinates of a joint are angles about axes: revolute,
/// continuous or universal.
[[nodiscard]] bool has_angles_alone(joints::JointKind kind);

/// Questions about drives and controllers: angles that are commanded beyond a
/// full turn and beyond the joint's stops, phases beyond one, a controller
/// whose period is longer than the run, and limits of a controller above those
/// of the drive that follows it.
[[nodiscard]] std::vector<std::string> question_commands(
    const Scenario& scenario, const Robot& robot);

}  // namespace limber::scene
