// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "joints/bushing.hpp"
#include "joints/joint.hpp"
#include "joints/latch.hpp"
#include "joints/point_spring.hpp"

namespace limber::joints {

/// Any law of two frames. A new law joins here, in docs/joints.md and in the
/// contract of coupler laws.
using CouplerLaw = std::variant<Bushing, PointSpring, Joint, Latch>;

[[nodiscard]] CouplerResponse evaluate(const CouplerLaw& law,
                                       const RelativeMotion& motion,
                                       const CouplerMemory& memory,
                                       const Instant& now);

/// Its coordinates; none unless it is a joint.
[[nodiscard]] const std::vector<AxisCoordinate>& coordinates_of(
    const CouplerLaw& law);

/// Times at which a drive's command or a derivative of it jumps, increasing for
/// each drive [s].
[[nodiscard]] std::vector<double> break_times(const CouplerLaw& law);

}  // namespace limber::joints
