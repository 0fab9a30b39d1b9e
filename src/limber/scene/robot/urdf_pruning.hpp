// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <string>

namespace limber::scene {

/// The text of a robot without what urdfdom may refuse though nobody uses it:
/// shapes, materials, controllers and calibrations, and, of fixed joints, axis,
/// limit, dynamics and mimic. Without a <limit> a joint has no stops, and
/// drives are unlimited where that has no effort or velocity.
[[nodiscard]] std::string prune_urdf(const TiXmlDocument& robot);

}  // namespace limber::scene
