// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/index.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/pairs/touching.hpp"

namespace limber::dynamics {

/// How far the points of bodies that may touch have moved since the start, at
/// most: what is farther apart than both bodies' ways needs no look.
///
/// Equation   way_b += margin h max(v_b), at both ends of a step,
///            v_b = |v| + |w| (extent + sum reach_k |eta_k|)
///            + sum reach_k |etadot_k|, over modes and their products
/// Limits     as TouchWatch: speeds between a step's ends are at most `margin`
///            times those at its ends
class TravelBound {
 public:
  explicit TravelBound(const SystemModel& model);

  /// Takes in a body's points. @param body kWorld does nothing
  void include(BodyIndex body, const joints::TouchReach& reach);

  /// Of all bodies at a state [m/s].
  void find_speeds(const SystemModel& model, const SystemState& state,
                   std::vector<double>& speeds) const;

  /// Adds the ways of a step [m].
  void advance(const std::vector<double>& ways);

  /// Of both bodies together since the start [m].
  [[nodiscard]] double find_way(BodyIndex A, BodyIndex B) const;

 private:
  struct Reach {
    bool is_member = false;
    double extent = 0.0;  // [m]
    VectorX modes;        // [kg^-1/2]
  };
  std::vector<Reach> reaches_;  // of each body
  std::vector<double> ways_;    // [m]
};

/// A body's entry; 0 of the world.
[[nodiscard]] inline double value_of(const std::vector<double>& values,
                                     BodyIndex body) {
  return body == kWorld ? 0.0 : values[index(body)];
}

}  // namespace limber::dynamics
