// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "dynamics/system_builder.hpp"
#include "scene/body_plan.hpp"
#include "scene/default_stiffness.hpp"
#include "scene/interface_tables.hpp"
#include "scene/link_motion.hpp"
#include "scene/scene.hpp"

namespace limber::scene {

/// A coupler's or a load's frame F on a body, and what it holds on to there.
struct Mount {
  std::string link;  ///< "world" is the world
  dynamics::BodyIndex body = dynamics::kWorld;
  Pose X_BF;         ///< undeformed; in the world if that is the body
  Anchor anchor;     ///< of a flexible link
  CouplerSide side;  ///< for default stiffness
};

/// Finds mounts on the bodies of a scene while its system is put together.
class Mounts {
 public:
  /// @param body_of_plan grows while bodies are added
  Mounts(const Scene& scene, const BodyPlans& plans,
         const std::vector<LinkMotion>& start,
         const std::vector<dynamics::BodyIndex>& body_of_plan)
      : scene_(scene),
        plans_(plans),
        start_(start),
        body_of_plan_(body_of_plan) {}

  [[nodiscard]] const BodyPlan& plan_of(int link) const;
  [[nodiscard]] dynamics::BodyIndex body_of(int link) const;
  [[nodiscard]] const Pose& X_BL(int link) const;
  /// Motion of all links at the start.
  [[nodiscard]] const std::vector<LinkMotion>& start() const { return start_; }

  [[nodiscard]] Mount find_mount(int link, const Pose& X_LF,
                                 const Anchor& anchor) const;

  /// Pose of an end in the world where links move as `motions` say: its
  /// point, or the middle of its interface, and the axes of its link.
  /// @throws InputError for a flexible link without nodes, a rigid one with.
  [[nodiscard]] Pose find_pose(const ConnectorEnd& end,
                               const std::vector<LinkMotion>& motions) const;
  /// A frame on an end's link that is at X_WF there.
  [[nodiscard]] Mount find_mount(const ConnectorEnd& end, const Pose& X_WF,
                                 const std::vector<LinkMotion>& motions) const;

 private:
  [[nodiscard]] Anchor find_end_anchor(const Place& where) const;

  const Scene& scene_;
  const BodyPlans& plans_;
  const std::vector<LinkMotion>& start_;
  const std::vector<dynamics::BodyIndex>& body_of_plan_;
};

[[nodiscard]] dynamics::AttachmentIndex attach(const std::string& name,
                                               const Mount& mount,
                                               dynamics::SystemBuilder&);

}  // namespace limber::scene
