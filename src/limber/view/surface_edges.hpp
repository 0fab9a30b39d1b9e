// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace limber::view {

using Edge = std::pair<std::int64_t, std::int64_t>;

/// Adds the edges of triangles, by the tags of their nodes.
/// @param corners three a triangle: indices of nodes
void add_edges(const std::vector<std::int64_t>& tags,
               const std::vector<std::int64_t>& corners,
               std::vector<Edge>& edges);

/// Whether triangles bound a solid: an even number of them at every edge.
[[nodiscard]] bool are_closed(std::vector<Edge> edges);

}  // namespace limber::view
