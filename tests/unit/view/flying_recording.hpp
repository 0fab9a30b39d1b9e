// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/view/recording.hpp"

namespace limber::view::test {

/// Where a recording is, how fast its bodies fly, when it begins.
struct Flight {
  Vector3 place = Vector3::Zero();     ///< [m]
  Vector3 velocity = Vector3::Zero();  ///< [m/s]
  double start = 0.0;                  ///< [s]
  double interval = 0.5;               ///< of outputs [s]
};

inline constexpr int kFlightOutputs = 21;

/// A flexible body "arm" and a rigid one "hub" of sizes of 0.3 m that fly
/// together and move by 0.1 m relative to each other, and an obstacle "post".
[[nodiscard]] Recording make_flight(const Flight& flight);

/// Adds a rigid body "stranger" that rests at a place.
void add_stranger(Recording& recording, const Vector3& place);

}  // namespace limber::view::test
