// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

/// Rows of nodes that are kept. Part of limber_reduction.
namespace limber::flexbody {

/// Index of a node in `kept`, which is sorted; none if it is not there.
[[nodiscard]] inline std::optional<std::size_t> find_kept_row(
    const std::vector<int>& kept, int node) {
  const auto found = std::lower_bound(kept.begin(), kept.end(), node);
  if (found == kept.end() || *found != node) return std::nullopt;
  return static_cast<std::size_t>(found - kept.begin());
}

/// Elements by the rows of their nodes; without those that lack one.
template <std::size_t count>
[[nodiscard]] std::vector<std::array<std::size_t, count>> find_kept_elements(
    const std::vector<std::array<int, count>>& elements,
    const std::vector<int>& kept) {
  std::vector<std::array<std::size_t, count>> found;
  for (const std::array<int, count>& nodes : elements) {
    std::array<std::size_t, count> rows{};
    std::size_t i = 0;
    for (; i < count; ++i) {
      const auto row = find_kept_row(kept, nodes[i]);
      if (!row) break;
      rows[i] = *row;
    }
    if (i == count) found.push_back(rows);
  }
  return found;
}

}  // namespace limber::flexbody
