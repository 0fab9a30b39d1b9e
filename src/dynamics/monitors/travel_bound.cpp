// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/travel_bound.hpp"

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/equations/mean_frame.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {

TravelBound::TravelBound(const SystemModel& model)
    : reaches_(model.bodies.size()), ways_(model.bodies.size(), 0.0) {
  for (std::size_t b = 0; b < reaches_.size(); ++b) {
    reaches_[b].modes = VectorX::Zero(count_coordinates(model.bodies[b]));
  }
}

void TravelBound::include(BodyIndex body, const joints::TouchReach& reach) {
  if (body == kWorld) return;
  Reach& all = reaches_[index(body)];
  all.is_member = true;
  const Eigen::Index count = reach.modes.size();
  // For an unreduced body, motion of its surface per displacement of a node.
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
    const BodyModel& own = model.bodies[b];
    const double* eta = state.eta.data() + own.offset;
    const double* etadot = state.etadot.data() + own.offset;
    for (int k = 0; k < own.modes; ++k) {
      extent += reach.modes[k] * std::abs(eta[k]);
      speed += reach.modes[k] * std::abs(etadot[k]);
    }
    flexbody::for_each_product(paired_of(own), [&](Eigen::Index pair, int i,
                                                   int j, bool is_square) {
      const double largest = reach.modes[own.modes + pair];
      extent += (is_square ? 0.5 : 1.0) * largest * std::abs(eta[i] * eta[j]);
      speed += largest *
               std::abs(is_square ? eta[i] * etadot[i]
                                  : eta[i] * etadot[j] + eta[j] * etadot[i]);
    });
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
