// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>
#include <vector>

#include "scene/problems.hpp"

namespace limber::scene {

/// Checks the words of URDF's own elements, of which urdfdom passes over those
/// that it does not know. Under <robot>, and in links and joints as far as they
/// are read: what is misspelt, given twice or left to xacro is a problem, what
/// nobody here knows a warning ("FILE:LINE: ..."), once for a word. What other
/// programs read (visual, transmission, gazebo, names with a colon ...) is
/// passed over.
void check_urdf_words(const TiXmlElement& robot, const std::string& file,
                      Problems& problems, std::vector<std::string>& warnings);

}  // namespace limber::scene
