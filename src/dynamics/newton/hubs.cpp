// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/hubs.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>

namespace limber::dynamics {
namespace {

// Bodies with few links are eliminated, which is more accurate.
constexpr double kMany = 8.0;
constexpr double kWorthIt = 2.0;

bool is_cheaper_as_hub(double links, double blocks) {
  const double as_block = links * links * links / 3.0;
  const double as_hub =
      links * blocks * blocks + blocks * blocks * blocks / 3.0;
  return links >= kMany && as_block > kWorthIt * as_hub;
}

}  // namespace

std::vector<int> choose_hubs(const std::vector<std::vector<int>>& links_of_body,
                             const std::vector<int>& blocks_of_body) {
  const auto links_of = [&](int b) -> const std::vector<int>& {
    return links_of_body[static_cast<std::size_t>(b)];
  };
  std::vector<int> bodies(links_of_body.size());
  std::iota(bodies.begin(), bodies.end(), 0);
  std::stable_sort(bodies.begin(), bodies.end(), [&](int a, int b) {
    return links_of(a).size() > links_of(b).size();
  });
  std::set<int> taken;
  std::vector<int> hubs;
  for (const int b : bodies) {
    const std::vector<int>& links = links_of(b);
    const int blocks = blocks_of_body[static_cast<std::size_t>(b)];
    if (blocks == 0 || !is_cheaper_as_hub(static_cast<double>(links.size()),
                                          static_cast<double>(blocks))) {
      continue;
    }
    if (std::any_of(links.begin(), links.end(),
                    [&](int link) { return taken.count(link) > 0; })) {
      continue;
    }
    taken.insert(links.begin(), links.end());
    hubs.push_back(b);
  }
  return hubs;
}

}  // namespace limber::dynamics
