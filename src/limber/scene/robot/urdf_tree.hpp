// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include "limber/scene/text/problems.hpp"

namespace limber::scene {

/// Checks what urdfdom only logs or reports without a line: missing or
/// duplicate names, joints whose links do not exist, a link with two parents,
/// loops, more than one root, joints of an unknown type or with parts that
/// Limber does not model.
void check_urdf_tree(const TiXmlElement& robot, Problems& problems);

}  // namespace limber::scene
