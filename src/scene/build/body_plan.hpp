// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/pose.hpp"
#include "dynamics/system_builder.hpp"
#include "flexbody/full_body.hpp"
#include "flexbody/reduced_body.hpp"
#include "scene/robot.hpp"

namespace limber::scene {

using ReducedPointer = std::shared_ptr<const flexbody::ReducedBody>;

using FullPointer = std::shared_ptr<const flexbody::FullBody>;

/// One body of the system: a flexible link, or rigid links that fixed joints
/// hold together.
struct BodyPlan {
  std::string name;  ///< of its first link
  std::vector<int> links;
  bool is_world = false;   ///< the link called world and what is fixed
  ReducedPointer reduced;  ///< null if rigid
  FullPointer full;        ///< null unless at level `full`
  double mass = 0.0;       ///< [kg]; 0 for the world
  Matrix3 inertia = Matrix3::Zero();  ///< about B, axes of B [kg m^2]
};

/// How the links of a robot become bodies.
struct BodyPlans {
  std::vector<BodyPlan> bodies;
  std::vector<int> body_of_link;    ///< index into `bodies`, one a link
  std::vector<Pose> X_BL;           ///< link frame in its body's, one a link
  std::vector<int> coupled_joints;  ///< joints that become couplers
};

/// Whether a joint holds two rigid links together as one body.
[[nodiscard]] bool merges(const Robot& robot, const Joint& joint);

/// Merges rigid links on fixed joints (parallel-axis theorem) and puts every
/// frame B at its centre of mass: axes of the first link if rigid, of the mesh
/// if flexible. The world's B is the root link.
/// @param reduced one entry a link; null where the link is rigid.
/// @throws InputError for a body without mass, or a clamped body that is not
/// the root or fixed to the world.
[[nodiscard]] BodyPlans plan_bodies(const Robot& robot,
                                    const std::vector<ReducedPointer>& reduced);

}  // namespace limber::scene
