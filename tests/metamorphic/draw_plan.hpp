// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "metamorphic/scene_plan.hpp"

namespace limber::metamorphic {

/// Of all scenes drawn [-].
inline constexpr double kNewtonTolerance = 1e-15;

/// Draws a scene that an integrator can follow in some 100 steps: one to six
/// bodies, rigid or flexible, held or free, on joints of all kinds with
/// springs, friction, stops and drives, on latches, cables, tendons and gears,
/// with loads, gravity and controllers. The same seed gives the same scene
/// everywhere. (testing::draw_scene draws extremes, and systems that cannot be
/// changed any more.)
[[nodiscard]] ScenePlan draw_plan(unsigned seed);

}  // namespace limber::metamorphic
