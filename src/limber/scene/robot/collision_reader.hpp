// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/robot/robot_options.hpp"
#include "limber/scene/text/problems.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {

/// Reads the <collision> of every link into the robot's. One without size, or
/// whose mesh is not there, is an OtherGeometry: an error for a contact, and
/// otherwise one warning of all of them.
void read_collisions(const TiXmlElement& root, const RobotOptions& options,
                     Robot& robot, Problems& problems);

/// The same for the <visual> of rigid links, in which nothing is an error.
/// @param robot with its extension
void read_visuals(const TiXmlElement& root, const RobotOptions& options,
                  Robot& robot);

/// Content of <contact link="...">.
[[nodiscard]] LinkContact read_link_contact(XmlElement& element);

}  // namespace limber::scene
