// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "joints/axis_coordinate.hpp"
#include "joints/bushing.hpp"
#include "joints/coupler_memory.hpp"
#include "joints/scalar_law.hpp"
#include "joints/universal_hold.hpp"

namespace limber::joints {

/// A scalar law along one of a joint's coordinates.
struct JointElement {
  int coordinate = 0;
  ScalarLaw law;
};

/// A joint: what it holds, and what acts along the coordinates it leaves free.
///
/// Equation   the sum of the hold's wrench and of force * gradient of each
///            element, with the coordinates of AxisCoordinate
class Joint {
 public:
  using Hold = std::variant<Bushing, UniversalHold>;

  /// @throws ContractError for more than kMaxCoordinates coordinates or
  /// kMaxSwitches switches, an axis that is not a unit vector, or an element on
  /// a coordinate that is not there.
  Joint(Hold hold, std::vector<AxisCoordinate> coordinates,
        std::vector<JointElement> elements);

  [[nodiscard]] const Hold& hold() const { return hold_; }
  [[nodiscard]] const std::vector<AxisCoordinate>& coordinates() const {
    return coordinates_;
  }
  [[nodiscard]] const std::vector<JointElement>& elements() const {
    return elements_;
  }

  /// @throws NumericalError as AxisCoordinate does.
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory,
                                         const Instant& now) const;

 private:
  Hold hold_;
  std::vector<AxisCoordinate> coordinates_;
  std::vector<JointElement> elements_;
  std::vector<std::size_t> first_switch_;  // one an element
};

/// Adds a force along a coordinate to a wrench and its derivatives.
void add_along(const CoordinateValue& coordinate, const RelativeMotion& motion,
               const ScalarResponse& scalar, CouplerResponse& response);

}  // namespace limber::joints
