// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/interface_tables.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "limber/common/index.hpp"
#include "limber/scene/build/recipes.hpp"

namespace limber::scene {
namespace {

flexbody::InterfaceTable row_table(const flexbody::ReducedBody& body,
                                   std::size_t row) {
  const auto i = static_cast<Eigen::Index>(row);
  flexbody::InterfaceTable table;
  table.p_B = body.rows.x_B.col(i);
  table.Phi_B = body.rows.Phi_B.middleRows(3 * i, 3);
  table.Psi_B = Matrix3X::Zero(3, body.mode_count());
  table.node_count = 1;
  if (body.manifold) {
    table.Phi2_B = body.manifold->Theta_B.middleRows(3 * i, 3);
    table.Psi2_B = Matrix3X::Zero(3, table.Phi2_B.cols());
  }
  return table;
}

/// A stored node of one of a link's bodies.
struct PlacedRow {
  int piece = 0;
  std::size_t row = 0;
};

PlacedRow find_tagged(std::span<const BodyPlan> pieces, std::size_t tag) {
  for (const BodyPlan& plan : pieces) {
    const auto& tags = plan.reduced->rows.tags;
    const auto found = std::find(tags.begin(), tags.end(), tag);
    if (found == tags.end()) continue;
    return {plan.piece, static_cast<std::size_t>(found - tags.begin())};
  }
  return {0, flexbody::find_row(*pieces.front().reduced, tag)};  // throws
}

PlacedRow find_nearest(std::span<const BodyPlan> pieces, const Vector3& p_M) {
  PlacedRow nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const BodyPlan& plan : pieces) {
    const flexbody::ReducedBody& body = *plan.reduced;
    const std::size_t row = flexbody::find_nearest_row(body, p_M);
    const Vector3 x_M =
        body.p_MoBcm_M + body.rows.x_B.col(static_cast<Eigen::Index>(row));
    const double distance = (x_M - p_M).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = {plan.piece, row};
  }
  return nearest;
}

std::optional<PlacedRow> find_node(std::span<const BodyPlan> pieces,
                                   const Place& place) {
  if (!place.nodes) return std::nullopt;
  if (const auto* node = std::get_if<flexbody::TaggedNode>(&*place.nodes)) {
    return find_tagged(pieces, node->tag);
  }
  if (const auto* near = std::get_if<flexbody::NearestNode>(&*place.nodes)) {
    return find_nearest(pieces, near->point);
  }
  return std::nullopt;
}

const BodyPlan* find_holder(std::span<const BodyPlan> pieces,
                            const std::string& interface) {
  for (const BodyPlan& plan : pieces) {
    for (const flexbody::InterfaceTable& table : plan.reduced->interfaces) {
      if (table.name == interface) return &plan;
    }
  }
  return nullptr;
}

}  // namespace

const flexbody::InterfaceTable& get_table(const flexbody::ReducedBody& body,
                                          const std::string& interface) {
  return body.interfaces[flexbody::find_interface(body, interface)];
}

Anchor find_anchor(std::span<const BodyPlan> pieces,
                   const std::string& interface) {
  const BodyPlan* holder = find_holder(pieces, interface);
  const BodyPlan& plan = holder == nullptr ? pieces.front() : *holder;
  Anchor anchor;
  anchor.piece = plan.piece;
  anchor.table = get_table(*plan.reduced, interface);
  if (plan.full) anchor.nodes = find_node_set(*plan.full, interface);
  return anchor;
}

Anchor find_anchor(std::span<const BodyPlan> pieces, const Place& place) {
  const std::string name = find_place_interface(place);
  if (find_holder(pieces, name) != nullptr) return find_anchor(pieces, name);
  const std::optional<PlacedRow> node = find_node(pieces, place);
  if (!node) return find_anchor(pieces, name);
  const BodyPlan& plan = pieces[index(node->piece)];
  Anchor anchor;
  anchor.piece = node->piece;
  anchor.table = row_table(*plan.reduced, node->row);
  if (plan.full) {
    // All rows are stored, so a row is a node.
    anchor.nodes = {name,
                    {static_cast<int>(node->row)},
                    VectorX::Ones(1),
                    Matrix3X::Zero(3, 1)};
  }
  return anchor;
}

int find_piece(std::span<const BodyPlan> pieces, const Place& place) {
  return find_anchor(pieces, place).piece;
}

}  // namespace limber::scene
