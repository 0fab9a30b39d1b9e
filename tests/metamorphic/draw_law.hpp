// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "metamorphic/random_draw.hpp"
#include "metamorphic/scene_plan.hpp"

namespace limber::metamorphic {

/// What laws are drawn about: their stiffness is of mass * frequency^2.
struct LawScale {
  double mass = 0.0;       ///< of the lighter body [kg]
  double length = 0.0;     ///< [m]
  double frequency = 0.0;  ///< [rad/s]
};

/// A joint of any kind with laws along its coordinates, a bushing or a latch,
/// without its frames.
[[nodiscard]] CouplerPlan draw_coupler(RandomDraw& draw, const LawScale& scale);
/// A spring or a cable between two points.
[[nodiscard]] CouplerPlan draw_point_spring(RandomDraw& draw,
                                            const LawScale& scale);
/// A law along a length.
[[nodiscard]] MakeLaw<joints::ScalarLaw> draw_tendon_law(RandomDraw& draw,
                                                         const LawScale& scale);
/// A law along a sum of angles.
[[nodiscard]] MakeLaw<joints::ScalarLaw> draw_gear_law(RandomDraw& draw,
                                                       const LawScale& scale);

}  // namespace limber::metamorphic
