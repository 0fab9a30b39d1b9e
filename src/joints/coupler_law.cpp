// SPDX-License-Identifier: BSD-3-Clause
#include "joints/coupler_law.hpp"

#include "common/overloaded.hpp"

namespace limber::joints {

CouplerResponse evaluate(const CouplerLaw& law, const RelativeMotion& motion,
                         const CouplerMemory& memory, const Instant& now) {
  return std::visit(
      Overloaded{
          [&](const Joint& joint) {
            return joint.evaluate(motion, memory, now);
          },
          [&](const PointSpring& spring) {
            return spring.evaluate(motion, memory.switches[0]);
          },
          [&](const Latch& latch) { return latch.evaluate(motion, memory); },
          [&](const auto& other) { return other.evaluate(motion); }},
      law);
}

const std::vector<AxisCoordinate>& coordinates_of(const CouplerLaw& law) {
  static const std::vector<AxisCoordinate> none;
  const auto* joint = std::get_if<Joint>(&law);
  return joint == nullptr ? none : joint->coordinates();
}

std::vector<double> break_times(const CouplerLaw& law) {
  std::vector<double> times;
  const auto* joint = std::get_if<Joint>(&law);
  if (joint == nullptr) return times;
  for (const JointElement& element : joint->elements()) {
    const std::vector<double> more = break_times(element.law);
    times.insert(times.end(), more.begin(), more.end());
  }
  return times;
}

}  // namespace limber::joints
