// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>
#include <vector>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// Checks <axis>, <limit>, <dynamics> and <mimic> of a robot's joints, with
/// their lines, before urdfdom reads them. Joints have names and known types.
void check_urdf_joints(const TiXmlElement& robot, Problems& problems,
                       std::vector<std::string>& warnings);

}  // namespace limber::scene
