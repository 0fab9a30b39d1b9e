// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include "scene/problems.hpp"
#include "scene/robot.hpp"

namespace limber::scene {

/// Adds to a robot with links and joints what Limber's own elements say:
/// <flexible>, <coupler>, <loop>, <spring>, <bushing>, <latch>, <tendon>,
/// <gear>. Elements of others are passed over.
void read_extension(const TiXmlElement& root, Robot& robot, Problems& problems);

}  // namespace limber::scene
