// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include <vector>

#include "limber/scene/text/toml_settings.hpp"

namespace limber::scene {

/// Applies settings to a robot: `robot.KIND.NAME.CHILD...ATTRIBUTE`, and an
/// index behind it for one number of several
/// (`robot.joint.elbow.origin.xyz.0`).
///
/// KIND is `link`, `joint` or one of Limber's own elements; NAME its name, link
/// or joint. Attributes of a `joint` beyond URDF belong to its <coupler>, which
/// is added if needed; so is a <contact> of a link. A child that can occur
/// several times is followed by name, joint, group or 0-based number; a missing
/// one is added. The readers check its name and value.
/// @throws InputError naming every setting with an unknown path, one that ends
/// at an element, or two for the same place.
void apply_settings(const std::vector<RobotSetting>& settings,
                    TiXmlElement& robot);

}  // namespace limber::scene
