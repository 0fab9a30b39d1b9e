// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

using ReducedPointer = std::shared_ptr<const flexbody::ReducedBody>;

using FullPointer = std::shared_ptr<const flexbody::FullBody>;

/// One body of the system: a flexible link, or rigid links connected by fixed
/// joints.
struct BodyPlan {
  std::string name;        ///< of its first link
  std::vector<int> links;  ///< indices of the robot's links
  bool is_world = false;   ///< the link called world and links fixed to it
  ReducedPointer reduced;  ///< null if rigid
  FullPointer full;        ///< null unless at level `full`
  double mass = 0.0;       ///< [kg]; 0 for the world
  Matrix3 inertia = Matrix3::Zero();  ///< about Bo, frame B [kg m^2]
};

/// Mapping of a robot's links to bodies.
struct BodyPlans {
  std::vector<BodyPlan> bodies;
  std::vector<int> body_of_link;    ///< index into `bodies`, one per link
  std::vector<Pose> X_BL;           ///< link frame in its body's, one per link
  std::vector<int> coupled_joints;  ///< indices of joints that become couplers
};

/// Merges rigid links on fixed joints (parallel-axis theorem) and places every
/// frame B at its centre of mass, with the axes of the first link if rigid, of
/// the mesh if flexible. The world's B is the root link.
/// @param reduced one entry per link; null if the link is rigid.
/// @throws InputError for a body without mass, or a clamped body that is not
/// the root or fixed to the world.
[[nodiscard]] BodyPlans plan_bodies(const Robot& robot,
                                    const std::vector<ReducedPointer>& reduced);

}  // namespace limber::scene
