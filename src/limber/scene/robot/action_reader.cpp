// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/robot/action_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"

namespace limber::scene {
namespace {

void take(std::optional<double>& value, const std::optional<double>& given) {
  if (given) value = given;
}

/// "x1 f1 x2 f2 ..." as points of a curve.
void read_table(XmlElement& element, joints::SpringCurve::Parameters& curve) {
  const auto numbers = element.numbers("table");
  if (!numbers) return;
  if (numbers->size() % 2 != 0) {
    element.fail(fmt::format(
        "table: expected pairs of extension and force, got {} numbers",
        numbers->size()));
    return;
  }
  for (std::size_t i = 0; i < numbers->size(); i += 2) {
    curve.extensions.push_back((*numbers)[i]);
    curve.forces.push_back((*numbers)[i + 1]);
  }
}

void check_stop(const XmlElement& element, const StopOptions& stop) {
  if (!stop.lower && !stop.upper) {
    element.fail("needs 'lower' or 'upper'; the joint has no <limit>");
  }
  if (stop.lower && stop.upper && *stop.lower > *stop.upper) {
    element.fail(fmt::format("lower={:g} is above upper={:g}; exchange them",
                             *stop.lower, *stop.upper));
  }
}

}  // namespace

ActionReader::ActionReader(joints::JointKind kind,
                           std::vector<JointAction>& actions)
    : actions_(actions), count_(static_cast<int>(count_coordinates(kind))) {}

std::map<std::string, XmlElement::Reader> ActionReader::readers() {
  return {{"stop", [this](XmlElement& e) { read_stop(e); }},
          {"friction", [this](XmlElement& e) { read_friction(e); }},
          {"spring", [this](XmlElement& e) { read_spring(e); }}};
}

std::optional<int> ActionReader::read_coordinate(XmlElement& element) {
  const bool is_given = element.has("coordinate");
  const auto number = element.integer("coordinate", 1, std::max(count_, 1));
  if (count_ == 0) {
    element.fail("acts along a coordinate, and this joint has none");
    return std::nullopt;
  }
  if (is_given && !number) return std::nullopt;
  if (!is_given && count_ > 1) {
    element.fail(fmt::format(
        "needs 'coordinate', 1 to {}: this joint has that many", count_));
    return std::nullopt;
  }
  return number.value_or(1) - 1;
}

template <typename Law>
const Law* ActionReader::find(int coordinate) const {
  for (const JointAction& action : actions_) {
    const Law* law = std::get_if<Law>(&action.law);
    if (law != nullptr && action.coordinate == coordinate) return law;
  }
  return nullptr;
}

template <typename Law>
void ActionReader::put(XmlElement& element, std::optional<int> coordinate,
                       const Law& law) {
  if (!coordinate) return;
  if (!seen_.emplace(element.tag(), *coordinate).second) {
    element.fail("is given twice for one coordinate");
  }
  std::erase_if(actions_, [&](const JointAction& action) {
    return action.coordinate == *coordinate &&
           std::holds_alternative<Law>(action.law);
  });
  actions_.push_back({*coordinate, law});
}

void ActionReader::read_stop(XmlElement& element) {
  const std::optional<int> coordinate = read_coordinate(element);
  const StopOptions* present =
      coordinate ? find<StopOptions>(*coordinate) : nullptr;
  StopOptions stop = present != nullptr ? *present : StopOptions{};
  take(stop.lower, element.number("lower"));
  take(stop.upper, element.number("upper"));
  stop.stiffness = element.number("stiffness", kPositive);
  stop.damping = element.number("damping", kNonNegative);
  if (stop.damping && (element.has("restitution") || element.has("speed"))) {
    element.fail("has 'damping' and 'restitution' or 'speed'; keep one");
  }
  stop.restitution = element.number("restitution", {0.0, 1.0, true, false})
                         .value_or(stop.restitution);
  stop.speed = element.number("speed", kPositive).value_or(stop.speed);
  check_stop(element, stop);
  put(element, coordinate, stop);
}

void ActionReader::read_friction(XmlElement& element) {
  const std::optional<int> coordinate = read_coordinate(element);
  const auto coulomb = element.number("coulomb", kNonNegative);
  const auto viscous = element.number("viscous", kNonNegative);
  if (!element.has("coulomb") && !element.has("viscous")) {
    element.fail("needs 'coulomb' or 'viscous'");
  }
  joints::Friction::Parameters friction;
  friction.coulomb = coulomb.value_or(0.0);
  friction.viscous = viscous.value_or(0.0);
  friction.speed = element.number("speed", kPositive).value_or(friction.speed);
  put(element, coordinate, friction);
}

void ActionReader::read_spring(XmlElement& element) {
  const std::optional<int> coordinate = read_coordinate(element);
  joints::ScalarSpring::Parameters spring;
  const joints::SpringCurve::Parameters curve = read_curve(element);
  try {
    spring.curve = joints::SpringCurve(curve);
  } catch (const InputError& error) {
    element.fail(error.what());
  }
  spring.damping = element.number("damping", kNonNegative).value_or(0.0);
  spring.rest = element.number("rest").value_or(0.0);
  spring.tension_only = element.boolean("tension_only").value_or(false);
  put(element, coordinate, spring);
}

joints::SpringCurve::Parameters read_curve(XmlElement& element) {
  joints::SpringCurve::Parameters curve;
  curve.stiffness = element.number("stiffness", kNonNegative).value_or(0.0);
  curve.quadratic = element.number("quadratic", kNonNegative).value_or(0.0);
  read_table(element, curve);
  if (!element.has("stiffness") && !element.has("quadratic") &&
      !element.has("table")) {
    element.fail("needs 'stiffness', 'quadratic' or 'table'");
  }
  return curve;
}

}  // namespace limber::scene
