// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/travel_bound.hpp"

#include <algorithm>
#include <cmath>

#include "limber/dynamics/equations/mean_frame.hpp"

namespace limber::dynamics {

TravelBound::TravelBound(const SystemModel& model)
    : reaches_(model.bodies.size()), ways_(model.bodies.size(), 0.0) {
  for (std::size_t b = 0; b < reaches_.size(); ++b) {
    reaches_[b].modes = VectorX::Zero(model.bodies[b].modes);
  }
}

void TravelBound::include(BodyIndex body, const joints::TouchReach& reach) {
  if (body == kWorld) return;
  Reach& all = reaches_[index(body)];
  all.is_member = true;
  const Eigen::Index count = reach.modes.size();
  // Of an unreduced body, how far its surface goes per displacement of a node.
  if (count > 0 && count != all.modes.size()) {
    all.extent = std::max(all.extent, reach.modes[count - 1]);
    return;
  }
  all.extent = std::max(all.extent, reach.extent);
  if (count > 0) all.modes = all.modes.cwiseMax(reach.modes);
}

void TravelBound::find_speeds(const SystemModel& model,
                              const SystemState& state,
                              std::vector<double>& speeds) const {
  for (std::size_t b = 0; b < reaches_.size(); ++b) {
    const Reach& reach = reaches_[b];
    speeds[b] = 0.0;
    if (!reach.is_member) continue;
    if (const int f = model.bodies[b].full; f >= 0) {
      const FullModel& full = model.full_bodies[index(f)];
      speeds[b] = reach.extent *
                  nodes_of(full, state.udot_H).colwise().norm().maxCoeff();
      continue;
    }
    const BodyState& body = state.bodies[b];
    double extent = reach.extent;
    double speed = body.v_WB_W.norm();
    for (Eigen::Index k = 0; k < reach.modes.size(); ++k) {
      const Eigen::Index at = model.bodies[b].offset + k;
      extent += reach.modes[k] * std::abs(state.eta[at]);
      speed += reach.modes[k] * std::abs(state.etadot[at]);
    }
    const double turn = body.w_WB_B.norm();
    if (turn > 0.0) speed += turn * extent;  // of a plane it is infinite
    speeds[b] = speed;
  }
}

void TravelBound::advance(const std::vector<double>& ways) {
  for (std::size_t b = 0; b < ways_.size(); ++b) {
    if (ways[b] > 0.0) ways_[b] += ways[b];
  }
}

double TravelBound::find_way(BodyIndex A, BodyIndex B) const {
  return value_of(ways_, A) + value_of(ways_, B);
}

}  // namespace limber::dynamics
