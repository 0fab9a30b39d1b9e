// SPDX-License-Identifier: BSD-3-Clause
#include "scene/mounts.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "scene/recipes.hpp"

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

Anchor Mounts::find_end_anchor(const Place& where) const {
  const BodyPlan& plan = plan_of(find_link(scene_.robot, where.link));
  const bool has_nodes = where.nodes || !where.interface.empty();
  if (!plan.reduced) {
    if (!has_nodes) return {};
    throw InputError(fmt::format(
        "link '{}' is rigid and has no nodes; give a point in its frame",
        where.link));
  }
  if (!has_nodes) {
    throw InputError(fmt::format(
        "link '{}' is flexible; name one of its interfaces or select nodes",
        where.link));
  }
  Anchor anchor = find_anchor(plan, where);
  if (where.point && anchor.table->rotation_rank() < 3) {
    throw InputError(fmt::format(
        "'{}' of link '{}' has too few nodes to carry a point beside them; "
        "leave 'point' out or select more nodes",
        find_place_interface(where), where.link));
  }
  return anchor;
}

Pose Mounts::find_pose(const ConnectorEnd& end,
                       const std::vector<LinkMotion>& motions) const {
  const Place& where = end.where;
  const Vector3 point = where.point.value_or(Vector3::Zero());
  if (where.link == "world") return {end.R, point};
  const int link = find_link(scene_.robot, where.link);
  const Pose& X_WL = motions[index(link)].X_WL;
  const Anchor anchor = find_end_anchor(where);
  if (!anchor.table || where.point) return X_WL * Pose{end.R, point};
  return {X_WL.R * end.R, X_WL * (X_BL(link).inverse() * anchor.table->p_B)};
}

Mount Mounts::find_mount(const ConnectorEnd& end, const Pose& X_WF,
                         const std::vector<LinkMotion>& motions) const {
  if (end.where.link == "world") {
    Mount mount;
    mount.link = end.where.link;
    mount.X_BF = X_WF;
    return mount;
  }
  const int link = find_link(scene_.robot, end.where.link);
  return find_mount(link, motions[index(link)].X_WL.inverse() * X_WF,
                    find_end_anchor(end.where));
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
