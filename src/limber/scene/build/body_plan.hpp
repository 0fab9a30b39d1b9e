// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "limber/common/pose.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/flexbody/model/full_body.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/scene/robot/robot.hpp"

namespace limber::scene {

using ReducedPointer = std::shared_ptr<const flexbody::ReducedBody>;

/// The bodies of a flexible link, one or its pieces in order; none if rigid.
using ReducedPieces = std::vector<ReducedPointer>;

using FullPointer = std::shared_ptr<const flexbody::FullBody>;

/// One body of the system: a flexible link or a piece of it, or rigid links
/// connected by fixed joints.
struct BodyPlan {
  std::string name;        ///< of its first link; of a piece "LINK.1", ...
  std::vector<int> links;  ///< indices of the robot's links
  bool is_world = false;   ///< the link called world and links fixed to it
  ReducedPointer reduced;  ///< null if rigid
  FullPointer full;        ///< null unless at level `full`
  double mass = 0.0;       ///< [kg]; 0 for the world
  Matrix3 inertia = Matrix3::Zero();  ///< about Bo, frame B [kg m^2]
  int piece = 0;                      ///< index among the link's bodies
  int piece_count = 1;                ///< of the link
  Vector3 p_FB = Vector3::Zero();     ///< Bo from that of the first piece [m]
};

/// Mapping of a robot's links to bodies.
struct BodyPlans {
  std::vector<BodyPlan> bodies;
  /// Index into `bodies`, one per link: of several pieces the first, which the
  /// others follow.
  std::vector<int> body_of_link;
  std::vector<Pose> X_BL;           ///< link frame in that body's, one per link
  std::vector<int> coupled_joints;  ///< indices of joints that become couplers
};

/// The bodies of a link: its pieces, or one.
[[nodiscard]] std::span<const BodyPlan> find_bodies(const BodyPlans& plans,
                                                    int link);

/// Frame of a link in the frame of one of its pieces.
[[nodiscard]] Pose find_X_BL(const BodyPlans& plans, int link, int piece);

/// The reduced bodies of a built system's links, as plan_bodies() takes them.
[[nodiscard]] std::vector<ReducedPieces> find_reduced(
    const Robot& robot, const dynamics::SystemModel& model);

/// Merges rigid links on fixed joints (parallel-axis theorem) and places every
/// frame B at its centre of mass, with the axes of the first link if rigid, of
/// the mesh if flexible. The world's B is the root link.
/// @param reduced one entry per link
/// @throws InputError for a body without mass, a clamped body that is neither
/// root nor fixed to the world, and a link named like another's piece.
[[nodiscard]] BodyPlans plan_bodies(const Robot& robot,
                                    const std::vector<ReducedPieces>& reduced);

}  // namespace limber::scene
