// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Joints that mimic a joint that does not move, or by a multiplier of 0, do
/// not move either: makes them fixed at the position that <mimic> requires,
/// with a warning, and removes their gears. @param robot without extension
void hold_mimics(Robot& robot);

}  // namespace limber::scene
