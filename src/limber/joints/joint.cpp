// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/joint.hpp"

#include <cmath>
#include <utility>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

Joint::Constraint without_stiffness(const Bushing& bushing) {
  Bushing::Parameters free = bushing.parameters();
  free.translational_stiffness.setZero();
  free.rotational_stiffness.setZero();
  free.coupling_stiffness.setZero();
  return Bushing(free);
}

Joint::Constraint without_stiffness(const UniversalConstraint& constraint) {
  UniversalConstraint::Parameters free = constraint.parameters();
  free.translational_stiffness = free.rotational_stiffness = 0.0;
  return UniversalConstraint(free);
}

Joint::Constraint find_acting(const Joint::Parameters& joint) {
  if (!joint.is_ideal) return joint.constraint;
  return std::visit(
      [](const auto& constraint) { return without_stiffness(constraint); },
      joint.constraint);
}

}  // namespace

Joint::Joint(Constraint constraint, std::vector<AxisCoordinate> coordinates,
             std::vector<JointElement> elements, bool is_ideal)
    : parameters_{std::move(constraint), std::move(coordinates),
                  std::move(elements), is_ideal},
      acting_(find_acting(parameters_)) {
  LIMBER_EXPECT(std::ssize(this->coordinates()) <= kMaxCoordinates);
  for (const AxisCoordinate& coordinate : this->coordinates()) {
    LIMBER_EXPECT(std::abs(coordinate.axis.norm() - 1.0) < 1e-9);
  }
  int switches = 0;
  for (const JointElement& element : this->elements()) {
    LIMBER_EXPECT(element.coordinate >= 0 &&
                  element.coordinate < std::ssize(this->coordinates()));
    first_switch_.push_back(static_cast<std::size_t>(switches));
    switches += joints::switch_count(element.law);
  }
  // The last element may read as many switch modes as a law may have.
  LIMBER_EXPECT(switches + kMaxScalarSwitches <= kMaxSwitches);
}

CouplerResponse Joint::evaluate(const RelativeMotion& motion,
                                const CouplerMemory& memory,
                                const EvaluationTime& now) const {
  CouplerResponse response = std::visit(
      [&](const auto& constraint) { return constraint.evaluate(motion); },
      acting_);
  add_constraint_wrench(motion, memory, response);
  if (elements().empty()) return response;
  // Laws along one coordinate are summed.
  for (std::size_t i = 0; i < coordinates().size(); ++i) {
    CoordinateValue value;
    ScalarResponse sum;
    bool acts = false;
    for (std::size_t e = 0; e < elements().size(); ++e) {
      const JointElement& element = elements()[e];
      if (element.coordinate != static_cast<int>(i)) continue;
      if (!acts) {
        value = joints::evaluate(coordinates()[i], motion, memory.near[i]);
      }
      acts = true;
      sum += joints::evaluate(element.law, {value.z, value.rate}, now,
                              modes_of(e, memory));
    }
    if (acts) add_along(value, motion, sum, response);
  }
  return response;
}

CouplerResponse Joint::evaluate_over_step(const MotionStep& motion,
                                          const CouplerMemory& memory,
                                          const StepTimes& times) const {
  CouplerResponse response = std::visit(
      [&](const auto& constraint) { return constraint.evaluate(motion.mean); },
      acting_);
  add_constraint_wrench(motion.mean, memory, response);
  for (std::size_t e = 0; e < elements().size(); ++e) {
    const JointElement& element = elements()[e];
    const auto i = static_cast<std::size_t>(element.coordinate);
    const CoordinateStep step =
        find_coordinate_step(coordinates()[i], motion, memory.near[i], times.h);
    const ScalarResponse scalar = joints::evaluate_over_step(
        element.law, step, times, modes_of(e, memory));
    CoordinateValue value;
    value.gradient = step.gradient;
    value.hessian = step.hessian;
    add_along(value, motion.mean, scalar, response);
  }
  return response;
}

RequiredSides Joint::find_required_rotations() const {
  RequiredSides required = std::visit(
      [](const auto& constraint) {
        return constraint.find_required_rotations();
      },
      constraint());
  for (const JointElement& element : elements()) {
    required +=
        joints::find_required_rotations(coordinates(), element.coordinate);
  }
  return required;
}

int Joint::switch_count() const {
  int count = 0;
  for (const JointElement& element : elements()) {
    count += joints::switch_count(element.law);
  }
  return count;
}

Joint::ElementSwitch Joint::find_element(int index) const {
  for (const JointElement& element : elements()) {
    const int count = joints::switch_count(element.law);
    if (index < count) return {element, index};
    index -= count;
  }
  throw ContractError("a joint's switch that does not exist");
}

SwitchValue Joint::find_switch(int index, const RelativeMotion& motion,
                               const CouplerMemory& memory,
                               double /*t*/) const {
  const ElementSwitch found = find_element(index);
  const auto c = static_cast<std::size_t>(found.element.coordinate);
  const CoordinateValue value =
      joints::evaluate(coordinates()[c], motion, memory.near[c]);
  return joints::find_switch(found.element.law, found.index,
                             {value.z, value.rate});
}

std::optional<EventKind> Joint::find_event(
    int index, bool rises, const CouplerMemory& /*memory*/) const {
  return joints::find_event(find_element(index).element.law, rises);
}

std::vector<double> Joint::break_times() const {
  std::vector<double> times;
  for (const JointElement& element : elements()) {
    const std::vector<double> more = joints::break_times(element.law);
    times.insert(times.end(), more.begin(), more.end());
  }
  return times;
}

std::vector<int> Joint::find_inputs() const {
  std::vector<int> inputs;
  for (const JointElement& element : elements()) {
    const std::vector<int> more = joints::find_inputs(element.law);
    inputs.insert(inputs.end(), more.begin(), more.end());
  }
  return inputs;
}

Vector6 Joint::find_target_velocity(const RelativeMotion& motion,
                                    const CouplerMemory& memory,
                                    const EvaluationTime& now) const {
  Vector6 target = Vector6::Zero();
  for (std::size_t i = 0; i < coordinates().size(); ++i) {
    TargetRate sum;
    CoordinateValue value;
    for (std::size_t e = 0; e < elements().size(); ++e) {
      const JointElement& element = elements()[e];
      if (element.coordinate != static_cast<int>(i)) continue;
      value = joints::evaluate(coordinates()[i], motion, memory.near[i]);
      sum.add(element.law, {value.z, value.rate}, now, modes_of(e, memory));
    }
    if (sum.rate() == 0.0) continue;
    target += sum.rate() / value.gradient.squaredNorm() * value.gradient;
  }
  return target;
}

std::optional<ConstraintStiffness> Joint::find_constraint_stiffness() const {
  if (is_ideal()) return std::nullopt;
  return std::visit(
      [](const auto& constraint) {
        return joints::find_constraint_stiffness(constraint);
      },
      constraint());
}

void Joint::add_constraint_wrench(const RelativeMotion& motion,
                                  const CouplerMemory& memory,
                                  CouplerResponse& response) const {
  if (memory.constraint_wrench.isZero(0.0)) return;
  response.wrench +=
      find_constraint_gap(motion).directions * memory.constraint_wrench;
}

ConstraintGap Joint::find_constraint_gap(const RelativeMotion& motion) const {
  return std::visit(
      [&](const auto& constraint) {
        return joints::find_constraint_gap(constraint, motion);
      },
      constraint());
}

ConstraintDeflection Joint::find_deflection(
    const ConstraintStiffness& stiffness, const RelativeMotion& motion) const {
  return std::visit(
      [&](const auto& constraint) {
        return joints::find_deflection(constraint, stiffness, motion);
      },
      constraint());
}

std::vector<AxisCoordinate::Kind> Joint::reading_kinds() const {
  std::vector<AxisCoordinate::Kind> kinds;
  for (const AxisCoordinate& c : coordinates()) kinds.push_back(c.kind);
  return kinds;
}

CoordinateReading Joint::read(int coordinate, const RelativeMotion& motion,
                              const CouplerMemory& memory,
                              const EvaluationTime& now) const {
  LIMBER_EXPECT(coordinate >= 0 && coordinate < std::ssize(coordinates()));
  const auto i = static_cast<std::size_t>(coordinate);
  const CoordinateValue value =
      joints::evaluate(coordinates()[i], motion, memory.near[i]);
  CoordinateReading reading{.motion = {value.z, value.rate}};
  for (std::size_t e = 0; e < elements().size(); ++e) {
    const JointElement& element = elements()[e];
    if (element.coordinate != coordinate) continue;
    reading.response +=
        joints::evaluate(element.law, reading.motion, now, modes_of(e, memory));
  }
  reading.effort = reading.response.force;
  return reading;
}

void add_along(const CoordinateValue& coordinate, const RelativeMotion& motion,
               const ScalarResponse& scalar, CouplerResponse& response) {
  const Vector6& g = coordinate.gradient;
  response.wrench += scalar.force * g;
  response.energy += scalar.energy;
  response.dissipation += scalar.dissipation;
  response.supplied += scalar.supplied;
  // The rate is g . velocity, and g rotates with the motion.
  Vector6 slope = scalar.stiffness * g;
  slope.tail<3>() +=
      scalar.damping * (coordinate.hessian.transpose() * motion.w_FM_F);
  response.stiffness += g * slope.transpose();
  response.stiffness.bottomRightCorner<3, 3>() -=
      scalar.force * coordinate.hessian;
  response.damping += scalar.damping * g * g.transpose();
}

}  // namespace limber::joints
