// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>
#include <vector>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// Checks the names of URDF elements and attributes, since urdfdom ignores
/// unknown ones. Under <robot>, and in links and joints as far as they are
/// read: misspelt, duplicate or unexpanded xacro names are problems, unknown
/// ones warnings ("FILE:LINE: ..."), once per name. Ignores elements of other
/// programs (visual, transmission, gazebo, names with a colon ...).
void check_urdf_names(const TiXmlElement& robot, const std::string& file,
                      Problems& problems, std::vector<std::string>& warnings);

}  // namespace limber::scene
