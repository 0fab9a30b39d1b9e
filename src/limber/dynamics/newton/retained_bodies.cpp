// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/retained_bodies.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>

#include "limber/common/index.hpp"

namespace limber::dynamics {
namespace {

// Bodies with few links are eliminated, which is more accurate.
constexpr double kMany = 8.0;
constexpr double kWorthIt = 2.0;
// The blocks of a retained body and of all its ancestors are joined.
constexpr int kDeepest = 4;

bool is_cheaper_as_hub(double links, double blocks) {
  const double as_block = links * links * links / 3.0;
  const double as_hub =
      links * blocks * blocks + blocks * blocks * blocks / 3.0;
  return links >= kMany && as_block > kWorthIt * as_hub;
}

class HubChoice {
 public:
  explicit HubChoice(const LinkGraph& graph) : graph_(graph) {}

  void consider(int body) {
    const std::vector<int>& links = graph_.links_of_body[index(body)];
    const int blocks = graph_.blocks[index(body)];
    if (blocks == 0 || !is_cheaper_as_hub(static_cast<double>(links.size()),
                                          static_cast<double>(blocks))) {
      return;
    }
    int parent = -1;
    if (graph_.moves[index(body)]) {
      if (needs_pivots(links)) return;
      const std::map<int, int> sharing = count_shared(links);
      if (!sharing.empty()) {
        const std::optional<int> chosen = choose_parent(sharing);
        if (!chosen) return;
        parent = *chosen;
      }
      for (const int link : links) {
        retained_of_link_[link].push_back(static_cast<int>(retained.size()));
      }
    }
    depths_.push_back(parent < 0 ? 0 : depths_[index(parent)] + 1);
    roots_.push_back(parent < 0 ? static_cast<int>(retained.size())
                                : roots_[index(parent)]);
    retained.push_back({body, parent});
  }

  std::vector<RetainedBody> retained;

 private:
  // Whether one of the links is an ideal joint of which no other end moves and
  // is eliminated.
  [[nodiscard]] bool needs_pivots(const std::vector<int>& links) const {
    return std::any_of(links.begin(), links.end(), [&](int link) {
      return graph_.ideal[index(link)] && (graph_.anchored[index(link)] ||
                                           retained_of_link_.count(link) > 0);
    });
  }

  // Retained bodies that the links end on, with how many of them.
  [[nodiscard]] std::map<int, int> count_shared(
      const std::vector<int>& links) const {
    std::map<int, int> count;
    for (const int link : links) {
      const auto found = retained_of_link_.find(link);
      if (found == retained_of_link_.end()) continue;
      for (const int one : found->second) ++count[one];
    }
    return count;
  }

  // The one that shares most; none if they belong to several trees.
  [[nodiscard]] std::optional<int> choose_parent(
      const std::map<int, int>& sharing) const {
    const int root = roots_[index(sharing.begin()->first)];
    std::optional<int> best;
    for (const auto& [one, count] : sharing) {
      if (roots_[index(one)] != root) return std::nullopt;
      if (depths_[index(one)] >= kDeepest) continue;
      if (!best || count > sharing.at(*best)) best = one;
    }
    return best;
  }

  const LinkGraph& graph_;
  std::map<int, std::vector<int>> retained_of_link_;
  std::vector<int> depths_;
  std::vector<int> roots_;
};

}  // namespace

std::vector<RetainedBody> choose_retained_bodies(const LinkGraph& graph) {
  std::vector<int> bodies(graph.links_of_body.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) {
    return graph.links_of_body[index(a)].size() >
           graph.links_of_body[index(b)].size();
  });
  HubChoice choice(graph);
  for (const int body : bodies) choice.consider(body);
  return choice.retained;
}

}  // namespace limber::dynamics
