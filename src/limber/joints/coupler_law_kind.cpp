// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coupler_law_kind.hpp"

#include "limber/common/errors.hpp"

namespace limber::joints {

const std::vector<AxisCoordinate>& WithoutCoordinates::coordinates() {
  static const std::vector<AxisCoordinate> none;
  return none;
}

const std::vector<JointElement>& WithoutCoordinates::elements() {
  static const std::vector<JointElement> none;
  return none;
}

CoordinateReading WithoutReadings::read(int /*coordinate*/,
                                        const RelativeMotion& /*motion*/,
                                        const CouplerMemory& /*memory*/,
                                        const EvaluationTime& /*now*/) {
  throw ContractError("a coordinate of a law that has none");
}

}  // namespace limber::joints
