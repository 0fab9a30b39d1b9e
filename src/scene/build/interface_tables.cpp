// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/interface_tables.hpp"

#include <optional>

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

std::optional<std::size_t> find_node(const flexbody::ReducedBody& body,
                                     const Place& place) {
  if (!place.nodes) return std::nullopt;
  if (const auto* node = std::get_if<flexbody::TaggedNode>(&*place.nodes)) {
    return flexbody::find_row(body, node->tag);
  }
  if (const auto* near = std::get_if<flexbody::NearestNode>(&*place.nodes)) {
    return flexbody::find_nearest_row(body, near->point);
  }
  return std::nullopt;
}

}  // namespace

const flexbody::InterfaceTable& get_table(const flexbody::ReducedBody& body,
                                          const std::string& interface) {
  return body.interfaces[flexbody::find_interface(body, interface)];
}

Anchor find_anchor(const BodyPlan& plan, const std::string& interface) {
  Anchor anchor;
  anchor.table = get_table(*plan.reduced, interface);
  if (plan.full) anchor.nodes = find_node_set(*plan.full, interface);
  return anchor;
}

Anchor find_anchor(const BodyPlan& plan, const Place& place) {
  const std::string name = find_place_interface(place);
  for (const flexbody::InterfaceTable& table : plan.reduced->interfaces) {
    if (table.name == name) return find_anchor(plan, name);
  }
  const std::optional<std::size_t> row = find_node(*plan.reduced, place);
  if (!row) return find_anchor(plan, name);
  Anchor anchor;
  anchor.table = row_table(*plan.reduced, *row);
  if (plan.full) {
    // All rows are stored, so a row is a node.
    anchor.nodes = {name, {static_cast<int>(*row)}, VectorX::Ones(1)};
  }
  return anchor;
}

}  // namespace limber::scene
