// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/retained_transports.hpp"

#include <algorithm>
#include <set>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

// Of each link the retained bodies with rigid motion that it ends on; none if
// it also ends elsewhere.
std::vector<std::vector<int>> find_retained_of_links(
    const LinkGraph& graph, const std::vector<RetainedBody>& retained) {
  std::vector<int> retained_of_body(graph.links_of_body.size(), -1);
  for (std::size_t one = 0; one < retained.size(); ++one) {
    const std::size_t body = index(retained[one].body);
    if (graph.moves[body]) retained_of_body[body] = static_cast<int>(one);
  }
  std::vector<std::vector<int>> retained_of_link(index(graph.links));
  std::vector<bool> is_outside = graph.grounded;
  for (std::size_t body = 0; body < graph.links_of_body.size(); ++body) {
    for (const int link : graph.links_of_body[body]) {
      retained_of_link[index(link)].push_back(retained_of_body[body]);
      if (retained_of_body[body] < 0) is_outside[index(link)] = true;
    }
  }
  for (std::size_t link = 0; link < retained_of_link.size(); ++link) {
    if (is_outside[link]) retained_of_link[link].clear();
  }
  return retained_of_link;
}

bool descends(const std::vector<RetainedBody>& retained, int one,
              int ancestor) {
  while (one >= 0 && one != ancestor) one = retained[index(one)].parent;
  return one == ancestor;
}

}  // namespace

RetainedTransports::RetainedTransports(
    const LinkGraph& graph, const std::vector<RetainedBody>& retained,
    const std::vector<int>& first_rows, int row_count,
    std::vector<std::pair<int, int>>& edges) {
  const bool has_children =
      std::any_of(retained.begin(), retained.end(),
                  [](const RetainedBody& one) { return one.parent >= 0; });
  if (!has_children) return;
  const std::vector<std::vector<int>> retained_of_link =
      find_retained_of_links(graph, retained);
  // A rigid motion of the ancestor with all its descendants.
  const auto is_unaffected = [&](int row, int ancestor) {
    if (row >= graph.links || retained_of_link[index(row)].empty())
      return false;
    const std::vector<int>& ends = retained_of_link[index(row)];
    return std::all_of(ends.begin(), ends.end(), [&](int one) {
      return descends(retained, one, ancestor);
    });
  };
  std::vector<std::set<int>> neighbours(index(row_count));
  const auto join = [&](int i, int j) {
    neighbours[index(i)].insert(j);
    neighbours[index(j)].insert(i);
  };
  for (const auto& [i, j] : edges) join(i, j);
  for (int i = static_cast<int>(retained.size()) - 1; i >= 0; --i) {
    const RetainedBody& one = retained[index(i)];
    if (one.parent < 0) continue;
    Transport t{.body = one.body,
                .parent_body = retained[index(one.parent)].body,
                .row = first_rows[index(i)],
                .parent_row = first_rows[index(one.parent)]};
    for (const int row : std::set<int>(neighbours[index(t.row)])) {
      if (row == t.parent_row || is_unaffected(row, one.parent)) continue;
      t.neighbours.push_back(row);
      join(row, t.parent_row);
      edges.emplace_back(row, t.parent_row);
    }
    join(t.row, t.parent_row);
    edges.emplace_back(t.row, t.parent_row);
    transports_.push_back(std::move(t));
  }
  for (std::size_t i = 0; i < retained.size(); ++i) {
    for (const int row : neighbours[index(first_rows[i])]) {
      const int one = static_cast<int>(i);
      if (is_unaffected(row, one)) unaffected_.emplace_back(row, first_rows[i]);
    }
  }
}

Matrix6 RetainedTransports::transport(const Pose& body, const Pose& parent) {
  Matrix6 T = Matrix6::Identity();
  T.topRightCorner<3, 3>() = -skew(body.p - parent.p) * parent.R;
  T.bottomRightCorner<3, 3>() = body.R.transpose() * parent.R;
  return T;
}

void RetainedTransports::transform(BlockLu& lu) const {
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

void RetainedTransports::transform_right(std::vector<Vector6>& b) const {
  for (const Transport& t : transports_) {
    b[index(t.parent_row)].noalias() += t.acting.transpose() * b[index(t.row)];
  }
}

void RetainedTransports::restore(std::vector<Vector6>& x) const {
  for (auto t = transports_.rbegin(); t != transports_.rend(); ++t) {
    x[index(t->row)].noalias() += t->moving * x[index(t->parent_row)];
  }
}

}  // namespace limber::dynamics
