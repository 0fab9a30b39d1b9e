// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/nastran/mid_side_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::fem {

void MidSideNodes::add(const SolidCard& solid,
                       const std::vector<std::size_t>& nodes, std::size_t first,
                       const std::string& name) {
  const auto corners = static_cast<std::size_t>(solid.corners);
  for (std::size_t i = corners; i < nodes.size(); ++i) {
    const auto& ends = solid.edges[i - corners];
    const auto edge = std::minmax(nodes[static_cast<std::size_t>(ends[0])],
                                  nodes[static_cast<std::size_t>(ends[1])]);
    if (nodes[i] > 0) {
      nodes_.emplace(edge, nodes[i]);
      continue;
    }
    const auto* const at =
        std::find(solid.order.begin(), solid.order.end(), static_cast<int>(i));
    blanks_.push_back(
        {solid.quadratic_type,
         first + static_cast<std::size_t>(at - solid.order.begin()), edge,
         name});
  }
}

std::vector<std::string> MidSideNodes::fill(const std::string& source,
                                            SolidDeck& deck) const {
  if (blanks_.empty()) return {};
  std::map<Edge, std::size_t> nodes = nodes_;
  const auto find_position = [&](std::size_t node) -> Vector3 {
    const auto at = std::ranges::lower_bound(deck.nodes, node);
    return deck.x.col(at - deck.nodes.begin());
  };
  std::vector<Vector3> made;
  std::size_t next = deck.nodes.back();
  for (const Blank& blank : blanks_) {
    const auto [at, is_new] = nodes.try_emplace(blank.edge, next + 1);
    if (is_new) {
      ++next;
      made.push_back(0.5 * (find_position(blank.edge.first) +
                            find_position(blank.edge.second)));
    }
    deck.solids.at(blank.type).nodes[blank.place] = at->second;
  }
  const auto old = deck.x.cols();
  deck.x.conservativeResize(3, old + std::ssize(made));
  for (std::size_t i = 0; i < made.size(); ++i) {
    deck.x.col(old + static_cast<Eigen::Index>(i)) = made[i];
    deck.nodes.push_back(next - made.size() + 1 + i);
  }
  std::string text = fmt::format(
      "{}: of {} blank mid-side nodes, the first of {}, {} are those of other "
      "elements on their edge",
      source, blanks_.size(), blanks_.front().name,
      blanks_.size() - made.size());
  if (!made.empty())
    text += fmt::format(
        ", {} new ones in its middle, which make the body a little softer than "
        "the deck's straight edge",
        made.size());
  return {text + "."};
}

}  // namespace limber::fem
