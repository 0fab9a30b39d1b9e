// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "limber/dynamics/system/default_stiffness.hpp"
#include "limber/dynamics/system/system_builder.hpp"
#include "limber/scene/build/body_plan.hpp"
#include "limber/scene/build/interface_tables.hpp"
#include "limber/scene/build/link_motion.hpp"
#include "limber/scene/build/scene.hpp"

namespace limber::scene {

using dynamics::CouplerSide;

/// A coupler's or a load's frame F on a body, and its attachment there.
struct AttachmentSite {
  std::string link;  ///< "world" is the world
  dynamics::BodyIndex body = dynamics::kWorld;
  Pose X_BF;         ///< undeformed; in the world if that is the body
  Anchor anchor;     ///< of a flexible link
  CouplerSide side;  ///< for default stiffness
};

/// Finds sites on the bodies of a scene while its system is built.
class AttachmentSites {
 public:
  /// @param body_of_plan grows while bodies are added
  AttachmentSites(const Scene& scene, const BodyPlans& plans,
                  const std::vector<LinkMotion>& start,
                  const std::vector<dynamics::BodyIndex>& body_of_plan)
      : scene_(scene),
        plans_(plans),
        start_(start),
        body_of_plan_(body_of_plan) {}

  /// The bodies of a link.
  [[nodiscard]] std::span<const BodyPlan> pieces_of(int link) const;
  /// One of these bodies, by default the first.
  [[nodiscard]] const BodyPlan& plan_of(int link, int piece = 0) const;
  [[nodiscard]] dynamics::BodyIndex body_of(int link, int piece = 0) const;
  [[nodiscard]] Pose X_BL(int link, int piece = 0) const;
  /// Motion of all links at the start.
  [[nodiscard]] const std::vector<LinkMotion>& start() const { return start_; }

  [[nodiscard]] AttachmentSite find_site(int link, const Pose& X_LF,
                                         const Anchor& anchor) const;

  /// Pose of an end in the world, with links at `motions`: its point, or the
  /// mean point of its interface, and the axes of its link.
  /// @throws InputError for a flexible link without nodes, or a rigid one with
  /// nodes.
  [[nodiscard]] Pose find_pose(const ConnectorEnd& end,
                               const std::vector<LinkMotion>& motions) const;
  /// A frame on an end's link, at X_WF with links at `motions`.
  [[nodiscard]] AttachmentSite find_site(
      const ConnectorEnd& end, const Pose& X_WF,
      const std::vector<LinkMotion>& motions) const;

 private:
  [[nodiscard]] Anchor find_end_anchor(const Place& where) const;

  const Scene& scene_;
  const BodyPlans& plans_;
  const std::vector<LinkMotion>& start_;
  const std::vector<dynamics::BodyIndex>& body_of_plan_;
};

[[nodiscard]] dynamics::AttachmentIndex attach(const std::string& name,
                                               const AttachmentSite& site,
                                               dynamics::SystemBuilder&);

}  // namespace limber::scene
