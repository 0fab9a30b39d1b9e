// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "limber/common/records/fields.hpp"
#include "limber/joints/bushing.hpp"
#include "limber/joints/coordinates/axis_coordinate.hpp"
#include "limber/joints/coupler_law_kind.hpp"
#include "limber/joints/scalar/scalar_law.hpp"
#include "limber/joints/universal_constraint.hpp"

namespace limber::joints {

/// A joint: stiffness in its constrained directions, and scalar laws along its
/// free coordinates.
///
/// Equation   the sum of the wrench of `constraint` and of force * gradient of
///            each element, with the coordinates of AxisCoordinate, and of
///            CouplerMemory::constraint_wrench. Of an ideal joint the latter
///            stands for that of `constraint`, and its deflection
///            (find_constraint_gap) is zero: the stiffness of `constraint`
///            tells which directions are constrained, and acts only where
///            analyses make stiff joints of ideal ones.
class Joint : public WithoutTriggers {
 public:
  using Constraint = std::variant<Bushing, UniversalConstraint>;
  struct Parameters {
    Constraint constraint;
    std::vector<AxisCoordinate> coordinates;
    std::vector<JointElement> elements;
    bool is_ideal = false;
  };

  /// @throws ContractError for more than kMaxCoordinates coordinates or
  /// kMaxSwitches switches, an axis that is not a unit vector, or an element on
  /// a coordinate that does not exist.
  Joint(Constraint constraint, std::vector<AxisCoordinate> coordinates,
        std::vector<JointElement> elements, bool is_ideal = false);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] const Constraint& constraint() const {
    return parameters_.constraint;
  }
  [[nodiscard]] const std::vector<AxisCoordinate>& coordinates() const {
    return parameters_.coordinates;
  }
  [[nodiscard]] const std::vector<JointElement>& elements() const {
    return parameters_.elements;
  }
  [[nodiscard]] bool is_ideal() const { return parameters_.is_ideal; }

  /// Deflection in the constrained directions, whether ideal or not.
  [[nodiscard]] ConstraintGap find_constraint_gap(
      const RelativeMotion& motion) const;

  /// @throws NumericalError as AxisCoordinate does.
  [[nodiscard]] CouplerResponse evaluate(const RelativeMotion& motion,
                                         const CouplerMemory& memory,
                                         const EvaluationTime& now) const;
  /// The sum of the constraint's wrench at the mean and of each element's
  /// response over the step.
  /// @throws NumericalError as AxisCoordinate does.
  [[nodiscard]] CouplerResponse evaluate_over_step(
      const MotionStep& motion, const CouplerMemory& memory,
      const StepTimes& times) const;

  [[nodiscard]] RequiredSides find_required_rotations() const;

  /// Switches of the elements, in their order.
  [[nodiscard]] int switch_count() const;
  [[nodiscard]] SwitchValue find_switch(int index, const RelativeMotion& motion,
                                        const CouplerMemory& memory,
                                        double t) const;
  [[nodiscard]] std::optional<EventKind> find_event(
      int index, bool rises, const CouplerMemory& memory) const;

  [[nodiscard]] std::vector<double> break_times() const;
  [[nodiscard]] std::vector<int> find_inputs() const;
  [[nodiscard]] Vector6 find_target_velocity(const RelativeMotion& motion,
                                             const CouplerMemory& memory,
                                             const EvaluationTime& now) const;

  [[nodiscard]] std::optional<ConstraintStiffness> find_constraint_stiffness()
      const;
  [[nodiscard]] ConstraintDeflection find_deflection(
      const ConstraintStiffness& stiffness, const RelativeMotion& motion) const;

  /// One for each coordinate.
  [[nodiscard]] std::vector<AxisCoordinate::Kind> reading_kinds() const;
  /// @throws ContractError for a coordinate that does not exist.
  /// @throws NumericalError as AxisCoordinate does.
  [[nodiscard]] CoordinateReading read(int coordinate,
                                       const RelativeMotion& motion,
                                       const CouplerMemory& memory,
                                       const EvaluationTime& now) const;

 private:
  // Along the directions that are constrained at the motion.
  void add_constraint_wrench(const RelativeMotion& motion,
                             const CouplerMemory& memory,
                             CouplerResponse& response) const;
  // An element, and the index of one of its switches.
  struct ElementSwitch {
    const JointElement& element;
    int index;
  };
  [[nodiscard]] ElementSwitch find_element(int index) const;
  // Positions of an element's switches.
  [[nodiscard]] SwitchModes modes_of(std::size_t element,
                                     const CouplerMemory& memory) const {
    const std::size_t first = first_switch_[element];
    return {memory.switches[first], memory.switches[first + 1]};
  }

  Parameters parameters_;
  Constraint acting_;  // what exerts forces: without stiffness if ideal
  std::vector<std::size_t> first_switch_;  // index, of each element
};

constexpr auto fields_of(const Joint::Parameters*) {
  return list_fields("joint", "hold", "coordinates", "elements", "is ideal");
}

/// Adds a force along a coordinate to a wrench and its derivatives.
void add_along(const CoordinateValue& coordinate, const RelativeMotion& motion,
               const ScalarResponse& scalar, CouplerResponse& response);

}  // namespace limber::joints
