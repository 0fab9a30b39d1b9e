// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// Reads Limber's own elements into a robot with links and joints: <flexible>,
/// <coupler>, <loop>, <spring>, <bushing>, <latch>, <tendon>, <gear>. Ignores
/// elements of other programs.
void read_extension(const TiXmlElement& root, Robot& robot, Problems& problems);

}  // namespace limber::scene
