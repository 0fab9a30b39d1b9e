// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/common/pose.hpp"
#include "limber/common/records/fields.hpp"
#include "limber/common/types.hpp"
#include "limber/joints/coordinates/switches.hpp"

namespace limber::joints {

enum class LatchStatus { open, closed, released };

/// Largest number of coordinates of a joint.
inline constexpr int kMaxCoordinates = 3;

/// Largest number of switches of a coupler.
inline constexpr int kMaxSwitches = 12;

/// History of a coupler. A plain value, part of the state; constant within a
/// step.
struct CouplerMemory {
  /// The coupler's coordinates at the end of the last step, including whole
  /// turns: angles are taken nearest to these [rad or m].
  std::array<double, kMaxCoordinates> near{};
  /// Positions of the coupler's switches, those of a joint's elements in order.
  std::array<SwitchMode, kMaxSwitches> switches{};
  LatchStatus latch = LatchStatus::open;
  Pose X_FM;  ///< rest pose of a closed latch [-], [m]
  /// Of an ideal joint, that of its constraint, as CouplerResponse::wrench
  /// [N, N m]; of a stiff one what acts beside its stiffness, at outputs within
  /// a step; and the last solution, at a time within the last step.
  Vector6 constraint_wrench = Vector6::Zero();
  Vector6 solved_wrench = Vector6::Zero();
  double solved_time = -kInfinity;  ///< [s]
};

constexpr auto fields_of(const CouplerMemory*) {
  return list_fields("memory", "near [rad, m]", "switches", "latch", "X_FM",
                     "constraint wrench [N, N m]", "solved wrench [N, N m]",
                     "solved time [s]");
}

}  // namespace limber::joints
