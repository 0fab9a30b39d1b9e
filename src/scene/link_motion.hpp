// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/pose.hpp"
#include "scene/robot.hpp"
#include "scene/scenario.hpp"

namespace limber::scene {

/// Motion of a link's frame at the start.
struct LinkMotion {
  Pose X_WL;
  Vector3 v_WL_W = Vector3::Zero();  ///< of its origin [m/s]
  Vector3 w_WL_W = Vector3::Zero();  ///< [rad/s]
};

/// Forward kinematics of the undeformed robot: one entry a link.
/// @throws InputError for joints that do not exist, wrong numbers of
/// coordinates, or a base motion of a robot that stands on the world.
[[nodiscard]] std::vector<LinkMotion> find_link_motions(
    const Robot& robot, const Scenario& scenario);

/// Coordinates that a joint of this kind has: 0, 1, 3 or 6.
[[nodiscard]] std::size_t coordinate_count(joints::JointKind kind);

}  // namespace limber::scene
