// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/lu_plan.hpp"

#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

using Edges = std::vector<std::pair<int, int>>;

void keep(const LinkGraph& graph, int body, bool precedes_links, LuPlan& plan) {
  const int blocks = graph.blocks[index(body)];
  plan.retained_of_body[index(body)] = static_cast<int>(plan.retained.size());
  plan.retained.push_back(
      {body, plan.rows, blocks, graph.sizes[index(body)], precedes_links});
  plan.rows += blocks;
}

void join_links(const std::vector<int>& links, Edges& edges) {
  for (const int i : links) {
    for (const int j : links) {
      if (i < j) edges.emplace_back(i, j);
    }
  }
}

void join_blocks(const RetainedUnknowns& body, const std::vector<int>& links,
                 Edges& edges) {
  for (int i = body.first; i < body.first + body.blocks; ++i) {
    for (const int link : links) edges.emplace_back(link, i);
    for (int j = body.first; j < i; ++j) edges.emplace_back(i, j);
  }
}

void join_bodies(const RetainedUnknowns& a, const RetainedUnknowns& b,
                 Edges& edges) {
  for (int i = a.first; i < a.first + a.blocks; ++i) {
    for (int j = b.first; j < b.first + b.blocks; ++j) edges.emplace_back(i, j);
  }
}

}  // namespace

LuPlan plan_lu(const LinkGraph& graph, const std::vector<BodyPair>& pairs) {
  LuPlan plan;
  plan.rows = graph.links;
  plan.retained_of_body.assign(graph.links_of_body.size(), -1);
  const std::vector<RetainedBody> retained = choose_retained_bodies(graph);
  std::vector<int> first_rows;
  for (const RetainedBody& one : retained) {
    first_rows.push_back(plan.rows);
    keep(graph, one.body, false, plan);
  }
  const int first_preceding = plan.rows;
  for (const auto& [a, b] : pairs) {
    for (const int body : {a, b}) {
      if (body < 0 || plan.retained_of_body[index(body)] >= 0) continue;
      keep(graph, body, true, plan);
    }
  }
  Edges edges;
  for (std::size_t b = 0; b < graph.links_of_body.size(); ++b) {
    if (plan.retained_of_body[b] >= 0) continue;
    join_links(graph.links_of_body[b], edges);
  }
  for (const RetainedUnknowns& body : plan.retained) {
    join_blocks(body, graph.links_of_body[index(body.body)], edges);
  }
  for (const auto& [a, b] : pairs) {
    if (a < 0 || b < 0) continue;
    join_bodies(plan.retained[index(plan.retained_of_body[index(a)])],
                plan.retained[index(plan.retained_of_body[index(b)])], edges);
  }
  plan.transports =
      RetainedTransports(graph, retained, first_rows, plan.rows, edges);
  plan.lu = BlockLu(plan.rows, edges, first_preceding);
  return plan;
}

}  // namespace limber::dynamics
