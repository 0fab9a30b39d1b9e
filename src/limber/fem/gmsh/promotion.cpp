// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/gmsh/promotion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "limber/common/errors.hpp"

namespace limber::fem {
namespace {

using Edges = std::vector<std::pair<int, int>>;

/// A type of first order and its serendipity type, with the edges of the
/// mid-side nodes in Gmsh's order (reference manual, "Node ordering").
struct Promotion {
  int from, to;
  Edges edges;
};

const Promotion* find_promotion(int gmsh_type) {
  static const std::array<Promotion, 7> known = {{
      {1, 8, {{0, 1}}},
      {2, 9, {{0, 1}, {1, 2}, {2, 0}}},
      {3, 16, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
      {4, 11, {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}}},
      {5,
       17,
       {{0, 1},
        {0, 3},
        {0, 4},
        {1, 2},
        {1, 5},
        {2, 3},
        {2, 6},
        {3, 7},
        {4, 5},
        {4, 7},
        {5, 6},
        {6, 7}}},
      {6,
       18,
       {{0, 1},
        {0, 2},
        {0, 3},
        {1, 2},
        {1, 4},
        {2, 5},
        {3, 4},
        {3, 5},
        {4, 5}}},
      {7, 19, {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}},
  }};
  const auto* const found =
      std::find_if(known.begin(), known.end(),
                   [&](const Promotion& p) { return p.from == gmsh_type; });
  return found == known.end() ? nullptr : found;
}

class Promoter {
 public:
  explicit Promoter(Mesh& mesh)
      : mesh_(mesh),
        types_(mesh.source),
        next_(static_cast<int>(mesh.node_count())) {}

  void promote() {
    for (ElementBlock& block : mesh_.blocks) promote(block);
    for (PhysicalGroup& group : mesh_.groups) {
      for (ElementBlock& block : group.blocks) {
        promote(block);
        group.nodes.insert(group.nodes.end(), block.nodes.begin(),
                           block.nodes.end());
      }
      std::sort(group.nodes.begin(), group.nodes.end());
      group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()),
                        group.nodes.end());
    }
    add_nodes();
  }

 private:
  void promote(ElementBlock& block) {
    const Promotion* const promotion = find_promotion(block.element->gmsh_type);
    if (promotion == nullptr) return;  // points
    std::vector<int> nodes;
    for (std::size_t e = 0; e < block.size(); ++e) {
      const int* const corners = block.element_nodes(e);
      nodes.insert(nodes.end(), corners, corners + block.element->node_count);
      for (const auto& [a, b] : promotion->edges)
        nodes.push_back(find_middle(corners[a], corners[b]));
    }
    block.element = types_.get(promotion->to);
    block.nodes = std::move(nodes);
  }

  int find_middle(int a, int b) {
    const auto [entry, is_new] = middles_.emplace(std::minmax(a, b), next_);
    if (is_new) ++next_;
    return entry->second;
  }

  void add_nodes() {
    const std::size_t last =
        *std::max_element(mesh_.tags.begin(), mesh_.tags.end());
    const Eigen::Index old = mesh_.x.cols();
    mesh_.x.conservativeResize(3, next_);
    mesh_.tags.resize(static_cast<std::size_t>(next_));
    for (const auto& [ends, node] : middles_) {
      mesh_.x.col(node) =
          0.5 * (mesh_.x.col(ends.first) + mesh_.x.col(ends.second));
      mesh_.tags[static_cast<std::size_t>(node)] =
          last + 1 + static_cast<std::size_t>(node - old);
    }
  }

  Mesh& mesh_;
  ElementTypes types_;
  std::map<std::pair<int, int>, int> middles_;
  int next_;
};

}  // namespace

void promote_to_second_order(Mesh& mesh) {
  const auto has_order = [](int order) {
    return [order](const ElementBlock& block) {
      return block.element->order == order;
    };
  };
  if (std::all_of(mesh.blocks.begin(), mesh.blocks.end(), has_order(2))) return;
  if (!is_first_order(mesh))
    throw InputError(fmt::format(
        "{}: order 2 was asked for, but the mesh has elements of order {} or "
        "of several orders. Expected first order; leave the order out.",
        mesh.source, mesh.blocks.at(0).element->order));
  Promoter(mesh).promote();
}

}  // namespace limber::fem
