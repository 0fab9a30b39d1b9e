// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Whether all coordinates of a joint are angles about axes: revolute,
/// continuous or universal.
[[nodiscard]] bool has_angles_alone(joints::JointKind kind);

/// Whether an angle is beyond a stop of a coordinate, by more than `beyond`,
/// and would be within all of them as degrees.
/// @param coordinate its index, from 0
[[nodiscard]] bool fits_as_degrees(const std::vector<JointAction>& actions,
                                   int coordinate, double angle,
                                   double beyond = 0.0);

/// The value of largest magnitude that a command has; of an input: none. A
/// shaper is left out [unit of the command].
[[nodiscard]] std::optional<double> find_extreme(const joints::Signal& signal);

/// Questions about angles of a scene that are likely in degrees: orientations
/// of robots, projectiles and obstacles beyond a full turn, starts beyond one
/// or only as degrees within the joint's stops, and stops beyond two turns of a
/// joint without a gear, and that neither starts nor is commanded beyond one
/// turn.
[[nodiscard]] std::vector<std::string> question_angles(const Scenario& scenario,
                                                       const Robot& robot);

}  // namespace limber::scene
