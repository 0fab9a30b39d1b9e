// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// Largest nesting depth of elements in a robot file. TinyXML, and other code
/// that walks its tree, is recursive and could overflow the stack.
inline constexpr int kMostNestedElements = 200;

/// Adds a problem if the text nests deeper, before anything parses it.
void check_xml_depth(std::string_view xml, Problems& problems);

}  // namespace limber::scene
