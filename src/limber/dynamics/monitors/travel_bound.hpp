// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/surface_reach.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::dynamics {

/// Upper bounds of the travel of bodies' points since the start: pairs with a
/// larger distance than both bodies' travel need no evaluation.
///
/// Equation   way_b += margin h max(v_b), at both ends of a step,
///            v_b = |v| + |w| (extent + sum reach_k |eta_k|)
///            + sum reach_k |etadot_k|, over modes and their products
/// Limits     as ContactStartObserver: speeds between a step's ends are at most
/// `margin`
///            times those at its ends
class TravelBound {
 public:
  explicit TravelBound(const SystemModel& model);

  /// Includes a body's points. @param body kWorld has no effect
  void include(const SystemModel& model, BodyIndex body,
               const joints::TouchReach& points);

  /// Speeds of all bodies at a state [m/s].
  void find_speeds(const SystemModel& model, const SystemState& state,
                   std::vector<double>& speeds) const;

  /// Adds the travel in a step [m].
  void advance(const std::vector<double>& ways);

  /// Travel of both bodies together since the start [m].
  [[nodiscard]] double find_way(BodyIndex A, BodyIndex B) const;

 private:
  std::vector<SurfaceReach> reaches_;  // of each body
  std::vector<double> ways_;           // [m]
};

/// A body's entry; 0 of the world.
[[nodiscard]] inline double value_of(const std::vector<double>& values,
                                     BodyIndex body) {
  return body == kWorld ? 0.0 : values[index(body)];
}

}  // namespace limber::dynamics
