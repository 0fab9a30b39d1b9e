// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>

namespace limber::scene {

/// The text of a robot without what urdfdom may refuse though nobody uses it:
/// shapes, materials, controllers and calibrations, and, of fixed joints, axis,
/// limit, dynamics and mimic. Drives are unlimited where a <limit> has no
/// effort or velocity.
[[nodiscard]] std::string prune_urdf(const TiXmlDocument& robot);

}  // namespace limber::scene
