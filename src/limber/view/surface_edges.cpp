// SPDX-License-Identifier: BSD-3-Clause
#include "limber/view/surface_edges.hpp"

#include <algorithm>

namespace limber::view {

void add_edges(const std::vector<std::int64_t>& tags,
               const std::vector<std::int64_t>& corners,
               std::vector<Edge>& edges) {
  const auto tag_of = [&](std::size_t corner) {
    return tags[static_cast<std::size_t>(corners[corner])];
  };
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    edges.push_back(std::minmax({tag_of(i), tag_of(next)}));
  }
}

bool are_closed(std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto end = std::upper_bound(edge, edges.end(), *edge);
    if ((end - edge) % 2 != 0) return false;
    edge = end;
  }
  return true;
}

}  // namespace limber::view
