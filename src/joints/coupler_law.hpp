// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "joints/bushing.hpp"
#include "joints/point_spring.hpp"

namespace limber::joints {

/// Any coupler law. A new law joins here and in docs/joints.md.
using CouplerLaw = std::variant<Bushing, PointSpring>;

[[nodiscard]] inline CouplerResponse evaluate(const CouplerLaw& law,
                                              const RelativeMotion& motion) {
  return std::visit([&](const auto& l) { return l.evaluate(motion); }, law);
}

}  // namespace limber::joints
