// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/shortest_impact.hpp"

#include <algorithm>
#include <cmath>

namespace limber::dynamics {

std::map<std::string, double> find_shortest_impacts(
    const std::vector<ContactRecord>& records) {
  std::map<std::string, double> shortest;
  for (const ContactRecord& record : records) {
    const double duration = record.impact_duration;
    if (!(duration > 0.0) || std::isinf(duration)) continue;
    const auto [at, is_new] = shortest.emplace(record.pair, duration);
    if (!is_new) at->second = std::min(at->second, duration);
  }
  return shortest;
}

}  // namespace limber::dynamics
