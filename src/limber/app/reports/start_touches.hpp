// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/joints/pairs/touching.hpp"
#include "limber/scene/build/build_system.hpp"

namespace limber::app {

/// Where the bodies of a pair are closest at the start.
struct StartTouch {
  const dynamics::Pair* pair = nullptr;
  const joints::Touching* law = nullptr;
  joints::PairTouch touch;
  double gap = 0.0;  ///< negative where they overlap [m]

  /// Whether the closest points are known; else only the gap.
  [[nodiscard]] bool has_place() const { return !touch.normal_W.isZero(0.0); }
};

/// Of all pairs that touch. @param built stored by reference
[[nodiscard]] std::vector<StartTouch> find_start_touches(
    const scene::BuiltScene& built);

}  // namespace limber::app
