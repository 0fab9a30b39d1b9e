// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/travel_bound.hpp"

#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/system/body_model.hpp"

namespace limber::dynamics {

TravelBound::TravelBound(const SystemModel& model)
    : reaches_(model.bodies.size()), ways_(model.bodies.size(), 0.0) {
  for (std::size_t b = 0; b < reaches_.size(); ++b) {
    reaches_[b].modes = VectorX::Zero(count_coordinates(model.bodies[b]));
  }
}

void TravelBound::include(const SystemModel& model, BodyIndex body,
                          const joints::TouchReach& points) {
  if (body == kWorld) return;
  SurfaceReach& reach = reaches_[index(body)];
  reach.is_member = true;
  visit_body(model, index(body),
             [&](const auto& own) { own.include(points, reach); });
}

void TravelBound::find_speeds(const SystemModel& model,
                              const SystemState& state,
                              std::vector<double>& speeds) const {
  for (std::size_t b = 0; b < reaches_.size(); ++b) {
    const SurfaceReach& reach = reaches_[b];
    speeds[b] = 0.0;
    if (!reach.is_member) continue;
    speeds[b] = visit_body(model, b, [&](const auto& own) {
      return own.find_speed(state, reach);
    });
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
