// SPDX-License-Identifier: BSD-3-Clause
#include "joints/joint.hpp"

#include <cmath>
#include <utility>

#include "common/errors.hpp"

namespace limber::joints {

Joint::Joint(Hold hold, std::vector<AxisCoordinate> coordinates,
             std::vector<JointElement> elements)
    : hold_(std::move(hold)),
      coordinates_(std::move(coordinates)),
      elements_(std::move(elements)) {
  LIMBER_EXPECT(std::ssize(coordinates_) <= kMaxCoordinates);
  for (const AxisCoordinate& coordinate : coordinates_) {
    LIMBER_EXPECT(std::abs(coordinate.axis.norm() - 1.0) < 1e-9);
  }
  int switches = 0;
  for (const JointElement& element : elements_) {
    LIMBER_EXPECT(element.coordinate >= 0 &&
                  element.coordinate < std::ssize(coordinates_));
    first_switch_.push_back(static_cast<std::size_t>(switches));
    switches += switch_count(element.law);
  }
  // The last element is handed as many modes as a law may have.
  LIMBER_EXPECT(switches + kMaxScalarSwitches <= kMaxSwitches);
}

CouplerResponse Joint::evaluate(const RelativeMotion& motion,
                                const CouplerMemory& memory,
                                const Instant& now) const {
  CouplerResponse response = std::visit(
      [&](const auto& hold) { return hold.evaluate(motion); }, hold_);
  if (elements_.empty()) return response;
  // Laws of one coordinate act together.
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    CoordinateValue value;
    ScalarResponse sum;
    bool acts = false;
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const JointElement& element = elements_[e];
      if (element.coordinate != static_cast<int>(i)) continue;
      if (!acts) {
        value = joints::evaluate(coordinates_[i], motion, memory.near[i]);
      }
      acts = true;
      const std::size_t s = first_switch_[e];
      sum += joints::evaluate(element.law, {value.z, value.rate}, now,
                              {memory.switches[s], memory.switches[s + 1]});
    }
    if (acts) add_along(value, motion, sum, response);
  }
  return response;
}

void add_along(const CoordinateValue& coordinate, const RelativeMotion& motion,
               const ScalarResponse& scalar, CouplerResponse& response) {
  const Vector6& g = coordinate.gradient;
  response.wrench += scalar.force * g;
  response.energy += scalar.energy;
  response.dissipation += scalar.dissipation;
  response.supplied += scalar.supplied;
  // The rate is g . velocity, and g turns with the motion.
  Vector6 slope = scalar.stiffness * g;
  slope.tail<3>() +=
      scalar.damping * (coordinate.hessian.transpose() * motion.w_FM_F);
  response.stiffness += g * slope.transpose();
  response.stiffness.bottomRightCorner<3, 3>() -=
      scalar.force * coordinate.hessian;
  response.damping += scalar.damping * g * g.transpose();
}

}  // namespace limber::joints
