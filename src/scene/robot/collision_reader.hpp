// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>

#include "limber/scene/robot/robot.hpp"
#include "limber/scene/text/problems.hpp"
#include "limber/scene/text/xml_element.hpp"

namespace limber::scene {

/// The text of a robot without <collision>, whose capsules urdfdom may refuse.
/// @param xml text of `robot`
[[nodiscard]] std::string remove_collisions(const TiXmlDocument& robot,
                                            const std::string& xml);

/// Reads the <collision> of every link into the robot's.
void read_collisions(const TiXmlElement& root, Robot& robot,
                     Problems& problems);

/// The same for the <visual> of rigid links. @param robot with its extension
void read_visuals(const TiXmlElement& root, Robot& robot, Problems& problems);

/// Content of <contact link="...">.
[[nodiscard]] LinkContact read_link_contact(XmlElement& element);

}  // namespace limber::scene
