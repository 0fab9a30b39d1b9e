// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml.h>

#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

/// Notes in each inertia where it is in the file.
void locate_inertias(const TiXmlElement& root, Robot& robot);

/// The inertia nearest to `inertia` (least sum of squares of the differences of
/// their entries) that a mass has: the largest principal moment at most the sum
/// of the others, none below 1e-6 of the largest. None for one that a mass has
/// within the rounding of printed digits, and for zero, which has no nearest.
[[nodiscard]] std::optional<Matrix3> find_nearest_inertia(
    const Matrix3& inertia);

/// Replaces the inertias of rigid links by the nearest that a mass has, with a
/// warning each.
void repair_inertias(Robot& robot);

}  // namespace limber::scene
