// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Questions about rigid links whose lengths are likely in another unit than
/// metres: longer than 100 m, longer than 5 m with less than 0.01 kg a metre,
/// or with shapes of less than 0.05 kg/m^3. And about those whose shapes, where
/// they enclose centre of mass and joints, have more than 25000 kg/m^3, or an
/// extent below 1/3 or above 30 times the radius of gyration.
///
/// Source     deployable booms, the lightest real links, have 0.05 kg/m and
///            more; helium has 0.18 kg/m^3. Millimetres that are read as metres
///            divide these by 1e3 and 1e9. Osmium has 22590 kg/m^3; a solid
///            sphere has a radius of gyration of 0.39 times its diameter
/// Limits     joints, centre of mass, and <collision> by primitive shapes; the
///            size of a mesh is that of its file
[[nodiscard]] std::vector<std::string> question_sizes(const Robot& robot);

}  // namespace limber::scene
