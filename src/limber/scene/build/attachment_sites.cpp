// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/attachment_sites.hpp"

#include <fmt/format.h>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/scene/build/recipes.hpp"

namespace limber::scene {
namespace {

CouplerSide make_side(const BodyPlan& plan, const Pose& X_BF,
                      const std::optional<flexbody::InterfaceTable>& table) {
  CouplerSide side;
  if (!plan.is_world && !(plan.reduced && plan.reduced->clamped)) {
    side = dynamics::make_side(plan.mass, plan.inertia, X_BF.p);
  }
  if (table) side.flexibility = table->flexibility;
  return side;
}

}  // namespace

std::span<const BodyPlan> AttachmentSites::pieces_of(int link) const {
  return find_bodies(plans_, link);
}

const BodyPlan& AttachmentSites::plan_of(int link, int piece) const {
  return pieces_of(link)[index(piece)];
}

dynamics::BodyIndex AttachmentSites::body_of(int link, int piece) const {
  return body_of_plan_[index(plans_.body_of_link[index(link)] + piece)];
}

Pose AttachmentSites::X_BL(int link, int piece) const {
  return find_X_BL(plans_, link, piece);
}

AttachmentSite AttachmentSites::find_site(int link, const Pose& X_LF,
                                          const Anchor& anchor) const {
  AttachmentSite site;
  site.link = scene_.robot.links[index(link)].name;
  site.body = body_of(link, anchor.piece);
  site.X_BF = X_BL(link, anchor.piece) * X_LF;
  site.anchor = anchor;
  site.side = make_side(plan_of(link, anchor.piece), site.X_BF, anchor.table);
  if (site.body == dynamics::kWorld) {
    site.X_BF = start_.front().X_WL * site.X_BF;
  }
  return site;
}

Anchor AttachmentSites::find_end_anchor(const Place& where) const {
  const int link = find_link(scene_.robot, where.link);
  const BodyPlan& plan = plan_of(link);
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
  Anchor anchor = find_anchor(pieces_of(link), where);
  if (where.point && anchor.table->rotation_rank() < 3) {
    throw InputError(
        fmt::format("'{}' of link '{}' has too few nodes to support a point "
                    "offset from them; leave 'point' out or select more nodes",
                    find_place_interface(where), where.link));
  }
  return anchor;
}

Pose AttachmentSites::find_pose(const ConnectorEnd& end,
                                const std::vector<LinkMotion>& motions) const {
  const Place& where = end.where;
  const Vector3 point = where.point.value_or(Vector3::Zero());
  if (where.link == "world") return {end.R, point};
  const int link = find_link(scene_.robot, where.link);
  const Pose& X_WL = motions[index(link)].X_WL;
  const Anchor anchor = find_end_anchor(where);
  if (!anchor.table || where.point) return X_WL * Pose{end.R, point};
  const Pose X_LB = X_BL(link, anchor.piece).inverse();
  return {X_WL.R * end.R, X_WL * (X_LB * anchor.table->p_B)};
}

AttachmentSite AttachmentSites::find_site(
    const ConnectorEnd& end, const Pose& X_WF,
    const std::vector<LinkMotion>& motions) const {
  if (end.where.link == "world") {
    AttachmentSite site;
    site.link = end.where.link;
    site.X_BF = X_WF;
    return site;
  }
  const int link = find_link(scene_.robot, end.where.link);
  return find_site(link, motions[index(link)].X_WL.inverse() * X_WF,
                   find_end_anchor(end.where));
}

dynamics::AttachmentIndex attach(const std::string& name,
                                 const AttachmentSite& site,
                                 dynamics::SystemBuilder& builder) {
  const auto& [piece, table, nodes] = site.anchor;
  if (site.body == dynamics::kWorld) {
    return builder.attach_world(name, site.X_BF);
  }
  if (!table) return builder.attach_frame(name, site.body, site.X_BF);
  if (nodes) return builder.attach_nodes(name, site.body, *nodes, site.X_BF);
  return builder.attach_interface(name, site.body, *table, site.X_BF);
}

}  // namespace limber::scene
