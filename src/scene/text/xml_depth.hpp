// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "scene/problems.hpp"

namespace limber::scene {

/// Elements inside elements that a robot file may have. TinyXML, and what else
/// walks through its tree, calls itself for each and would run out of stack.
inline constexpr int kMostNestedElements = 200;

/// Adds a problem if the text nests deeper, before anything parses it.
void check_xml_depth(std::string_view xml, Problems& problems);

}  // namespace limber::scene
