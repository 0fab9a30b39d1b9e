// SPDX-License-Identifier: BSD-3-Clause
#include "scene/mounts.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace limber::scene {
namespace {

std::size_t index(int i) { return static_cast<std::size_t>(i); }

CouplerSide make_side(const BodyPlan& plan, const Pose& X_BF,
                      const std::optional<flexbody::InterfaceTable>& table) {
  CouplerSide side;
  if (!plan.is_world && !(plan.reduced && plan.reduced->clamped)) {
    side.mass = plan.mass;
    side.inertia =
        plan.inertia.trace() / 3.0 + plan.mass * X_BF.p.squaredNorm();
  }
  if (table) side.flexibility = table->flexibility;
  return side;
}

}  // namespace

const BodyPlan& Mounts::plan_of(int link) const {
  return plans_.bodies[index(plans_.body_of_link[index(link)])];
}

dynamics::BodyIndex Mounts::body_of(int link) const {
  return body_of_plan_[index(plans_.body_of_link[index(link)])];
}

const Pose& Mounts::X_BL(int link) const { return plans_.X_BL[index(link)]; }

Mount Mounts::find_mount(int link, const Pose& X_LF,
                         const Anchor& anchor) const {
  Mount mount;
  mount.link = scene_.robot.links[index(link)].name;
  mount.body = body_of(link);
  mount.X_BF = X_BL(link) * X_LF;
  mount.anchor = anchor;
  mount.side = make_side(plan_of(link), mount.X_BF, anchor.table);
  if (mount.body == dynamics::kWorld) {
    mount.X_BF = start_.front().X_WL * mount.X_BF;
  }
  return mount;
}

Pose Mounts::find_pose(const ConnectorEnd& end,
                       const std::vector<LinkMotion>& motions) const {
  if (end.link == "world") return {end.R, end.point};
  const int link = find_link(scene_.robot, end.link);
  const BodyPlan& plan = plan_of(link);
  const Pose& X_WL = motions[index(link)].X_WL;
  if (!plan.reduced) return X_WL * Pose{end.R, end.point};
  if (end.interface.empty()) {
    throw InputError(fmt::format(
        "link '{}' is flexible; name one of its interfaces", end.link));
  }
  const Vector3& p_B = get_table(*plan.reduced, end.interface).p_B;
  return {X_WL.R * end.R, X_WL * (X_BL(link).inverse() * p_B)};
}

Mount Mounts::find_mount(const ConnectorEnd& end, const Pose& X_WF,
                         const std::vector<LinkMotion>& motions) const {
  if (end.link == "world") {
    Mount mount;
    mount.link = end.link;
    mount.X_BF = X_WF;
    return mount;
  }
  const int link = find_link(scene_.robot, end.link);
  const BodyPlan& plan = plan_of(link);
  return find_mount(link, motions[index(link)].X_WL.inverse() * X_WF,
                    plan.reduced ? find_anchor(plan, end.interface) : Anchor{});
}

dynamics::AttachmentIndex attach(const std::string& name, const Mount& mount,
                                 dynamics::SystemBuilder& builder) {
  const auto& [table, nodes] = mount.anchor;
  if (mount.body == dynamics::kWorld) {
    return builder.attach_world(name, mount.X_BF);
  }
  if (!table) return builder.attach_frame(name, mount.body, mount.X_BF);
  if (nodes) return builder.attach_nodes(name, mount.body, *nodes, mount.X_BF);
  return builder.attach_interface(name, mount.body, *table, mount.X_BF);
}

}  // namespace limber::scene
