// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// The robot of a scenario, or all of its robots as one (join_robots). Adds
/// the velocities of several robots to the joints' starts, since those are of
/// joints then.
/// @throws InputError with every problem of the files.
[[nodiscard]] Robot read_robots(Scenario& scenario);

}  // namespace limber::scene
