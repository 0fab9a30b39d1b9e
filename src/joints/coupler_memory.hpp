// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "common/pose.hpp"
#include "joints/scalar_motion.hpp"

namespace limber::joints {

enum class LatchStatus { open, closed, released };

/// Coordinates that a joint has, at most.
inline constexpr int kMaxCoordinates = 3;

/// Switches that a coupler has, at most.
inline constexpr int kMaxSwitches = 12;

/// What a coupler remembers between steps. A plain value, part of the state;
/// constant within a step.
struct CouplerMemory {
  /// Its coordinates at the last step's end, whole turns included: angles are
  /// counted on from here [rad or m].
  std::array<double, kMaxCoordinates> near{};
  /// Where its switches stand, those of a joint's elements in order.
  std::array<SwitchMode, kMaxSwitches> switches{};
  LatchStatus latch = LatchStatus::open;
  Pose X_FM;  ///< of a closed latch at rest
};

}  // namespace limber::joints
