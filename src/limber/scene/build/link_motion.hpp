// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/robot/robot.hpp"
#include "limber/scene/scenario/scenario.hpp"

namespace limber::scene {

/// Motion of a link's frame at the start.
struct LinkMotion {
  Pose X_WL;
  Vector3 v_WL_W = Vector3::Zero();  ///< of its origin [m/s]
  Vector3 w_WL_W = Vector3::Zero();  ///< [rad/s]
};

/// Forward kinematics of the undeformed robot: one entry per link. Projectiles
/// are at their start.
/// @throws InputError for joints that do not exist, wrong numbers of
/// coordinates, or a base motion of a robot fixed to the world.
[[nodiscard]] std::vector<LinkMotion> find_link_motions(
    const Robot& robot, const Scenario& scenario);

/// The same with all joints at zero; the root link is at its start.
[[nodiscard]] std::vector<LinkMotion> find_motions_at_zero(
    const Robot& robot, const Scenario& scenario);

/// Starts of joints: the scenario's; geared and mimicking joints without one
/// follow the other joint.
[[nodiscard]] std::map<std::string, JointStart> find_joint_starts(
    const Robot& robot, const Scenario& scenario);

/// Place of a body of the system in its link's frame; of several links that of
/// the first, of a link in pieces each piece.
struct PlacedBody {
  int link = 0;  ///< index of the robot's
  Pose X_LB;     ///< undeformed
};

/// One per body of the system.
[[nodiscard]] std::vector<PlacedBody> find_placed_bodies(
    const BodyPlans& plans);

/// Moves bodies with the frames of their links, which are undeformed.
/// @param bodies one per body of the state
/// @param motions one per link
void follow_links(const std::vector<PlacedBody>& bodies,
                  const std::vector<LinkMotion>& motions,
                  dynamics::SystemState& state);

}  // namespace limber::scene
