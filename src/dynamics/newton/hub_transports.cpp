// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/hub_transports.hpp"

#include <algorithm>
#include <set>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

// Of each link the hubs with rigid motion that it ends on; none if it also ends
// elsewhere.
std::vector<std::vector<int>> find_hubs_of_links(const LinkGraph& graph,
                                                 const std::vector<Hub>& hubs) {
  std::vector<int> hub_of_body(graph.links_of_body.size(), -1);
  for (std::size_t hub = 0; hub < hubs.size(); ++hub) {
    const std::size_t body = index(hubs[hub].body);
    if (graph.moves[body]) hub_of_body[body] = static_cast<int>(hub);
  }
  std::vector<std::vector<int>> hubs_of_link(index(graph.links));
  std::vector<bool> is_outside = graph.grounded;
  for (std::size_t body = 0; body < graph.links_of_body.size(); ++body) {
    for (const int link : graph.links_of_body[body]) {
      hubs_of_link[index(link)].push_back(hub_of_body[body]);
      if (hub_of_body[body] < 0) is_outside[index(link)] = true;
    }
  }
  for (std::size_t link = 0; link < hubs_of_link.size(); ++link) {
    if (is_outside[link]) hubs_of_link[link].clear();
  }
  return hubs_of_link;
}

bool descends(const std::vector<Hub>& hubs, int hub, int ancestor) {
  while (hub >= 0 && hub != ancestor) hub = hubs[index(hub)].parent;
  return hub == ancestor;
}

}  // namespace

HubTransports::HubTransports(const LinkGraph& graph,
                             const std::vector<Hub>& hubs,
                             const std::vector<int>& first_rows, int row_count,
                             std::vector<std::pair<int, int>>& edges) {
  const bool has_children = std::any_of(
      hubs.begin(), hubs.end(), [](const Hub& hub) { return hub.parent >= 0; });
  if (!has_children) return;
  const std::vector<std::vector<int>> hubs_of_link =
      find_hubs_of_links(graph, hubs);
  // A rigid motion of the ancestor with all its descendants.
  const auto is_unaffected = [&](int row, int ancestor) {
    if (row >= graph.links || hubs_of_link[index(row)].empty()) return false;
    const std::vector<int>& ends = hubs_of_link[index(row)];
    return std::all_of(ends.begin(), ends.end(),
                       [&](int hub) { return descends(hubs, hub, ancestor); });
  };
  std::vector<std::set<int>> neighbours(index(row_count));
  const auto join = [&](int i, int j) {
    neighbours[index(i)].insert(j);
    neighbours[index(j)].insert(i);
  };
  for (const auto& [i, j] : edges) join(i, j);
  for (int i = static_cast<int>(hubs.size()) - 1; i >= 0; --i) {
    const Hub& hub = hubs[index(i)];
    if (hub.parent < 0) continue;
    Transport t{.body = hub.body,
                .parent_body = hubs[index(hub.parent)].body,
                .row = first_rows[index(i)],
                .parent_row = first_rows[index(hub.parent)]};
    for (const int row : std::set<int>(neighbours[index(t.row)])) {
      if (row == t.parent_row || is_unaffected(row, hub.parent)) continue;
      t.neighbours.push_back(row);
      join(row, t.parent_row);
      edges.emplace_back(row, t.parent_row);
    }
    join(t.row, t.parent_row);
    edges.emplace_back(t.row, t.parent_row);
    transports_.push_back(std::move(t));
  }
  for (std::size_t i = 0; i < hubs.size(); ++i) {
    for (const int row : neighbours[index(first_rows[i])]) {
      const int hub = static_cast<int>(i);
      if (is_unaffected(row, hub)) unaffected_.emplace_back(row, first_rows[i]);
    }
  }
}

Matrix6 HubTransports::transport(const Pose& body, const Pose& parent) {
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = -skew(body.p - parent.p) * parent.R;
  T.bottomRightCorner<3, 3>() = body.R.transpose() * parent.R;
  return T;
}

void HubTransports::transform(BlockLu& lu) const {
  for (const Transport& t : transports_) {
    const auto add_column = [&](int row) {
      lu.block(row, t.parent_row).noalias() += lu.block(row, t.row) * t.moving;
    };
    const auto add_row = [&](int column) {
      lu.block(t.parent_row, column).noalias() +=
          t.acting.transpose() * lu.block(t.row, column);
    };
    for (const int row : t.neighbours) add_column(row);
    add_column(t.row);
    add_column(t.parent_row);
    for (const int column : t.neighbours) add_row(column);
    add_row(t.row);
    add_row(t.parent_row);
  }
  for (const auto& [link, row] : unaffected_) {
    lu.block(link, row).setZero();
    lu.block(row, link).setZero();
  }
}

void HubTransports::transform_right(std::vector<Vector6>& b) const {
  for (const Transport& t : transports_) {
    b[index(t.parent_row)].noalias() += t.acting.transpose() * b[index(t.row)];
  }
}

void HubTransports::restore(std::vector<Vector6>& x) const {
  for (auto t = transports_.rbegin(); t != transports_.rend(); ++t) {
    x[index(t->row)].noalias() += t->moving * x[index(t->parent_row)];
  }
}

}  // namespace limber::dynamics
