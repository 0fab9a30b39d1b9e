// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
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

/// The same where all joints are at zero; the root link is where it starts.
[[nodiscard]] std::vector<LinkMotion> find_motions_at_zero(
    const Robot& robot, const Scenario& scenario);

/// Starts of joints: the scenario's, and of geared and mimicking joints that it
/// leaves out where the other joint puts them.
[[nodiscard]] std::map<std::string, JointStart> find_joint_starts(
    const Robot& robot, const Scenario& scenario);

/// Numbers that say where a joint of this kind is: 0, 1, 2, 3 or 6.
[[nodiscard]] std::size_t coordinate_count(joints::JointKind kind);

}  // namespace limber::scene
