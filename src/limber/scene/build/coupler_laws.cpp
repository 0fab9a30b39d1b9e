// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/coupler_laws.hpp"

#include <cmath>

#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

using joints::AxisCoordinate;
using joints::Drive;
using joints::EndStop;
using joints::JointParameters;
using joints::ScalarLaw;
using joints::ScalarSpring;

EndStop make_stop(const StopOptions& options, double stiffness) {
  EndStop::Parameters stop;
  stop.lower = options.lower.value_or(stop.lower);
  stop.upper = options.upper.value_or(stop.upper);
  stop.stiffness = options.stiffness.value_or(stiffness);
  stop.damping = options.damping ? *options.damping
                                 : joints::find_stop_damping(
                                       options.restitution, options.speed);
  return EndStop(stop);
}

ScalarSpring make_linear(double stiffness, double damping, double rest,
                         bool tension_only) {
  joints::SpringCurve::Parameters curve;
  curve.stiffness = stiffness;
  ScalarSpring::Parameters spring;
  spring.curve = joints::SpringCurve(curve);
  spring.damping = damping;
  spring.rest = rest;
  spring.tension_only = tension_only;
  return ScalarSpring(spring);
}

}  // namespace

Constraint find_constraint(const AxisCoordinate& coordinate,
                           const JointParameters& held) {
  if (coordinate.kind == AxisCoordinate::Kind::angle) {
    return {held.rotational_stiffness, held.rotational_damping};
  }
  return {held.translational_stiffness, held.translational_damping};
}

std::vector<joints::JointElement> make_elements(
    const std::vector<JointAction>& actions,
    const std::vector<AxisCoordinate>& coordinates,
    const StopStiffness& stiffness) {
  std::vector<joints::JointElement> elements;
  for (const JointAction& action : actions) {
    const AxisCoordinate& coordinate =
        coordinates.at(static_cast<std::size_t>(action.coordinate));
    const bool rotates = coordinate.kind == AxisCoordinate::Kind::angle;
    const ScalarLaw law = std::visit(
        Overloaded{[&](const StopOptions& stop) -> ScalarLaw {
                     return make_stop(stop, rotates ? stiffness.rotational
                                                    : stiffness.translational);
                   },
                   [](const joints::Friction::Parameters& friction)
                       -> ScalarLaw { return joints::Friction(friction); },
                   [](const ScalarSpring::Parameters& spring) -> ScalarLaw {
                     return ScalarSpring(spring);
                   }},
        action.law);
    elements.push_back({action.coordinate, law});
  }
  return elements;
}

Drive make_drive(const DriveSpec& spec, double max_effort, double max_speed) {
  Drive::Parameters parameters = spec.drive;
  if (std::isinf(parameters.max_effort)) parameters.max_effort = max_effort;
  if (std::isinf(parameters.max_speed)) parameters.max_speed = max_speed;
  if (!spec.tendon.empty()) parameters.pulls_only = true;
  return Drive(parameters);
}

joints::PointSpring make_spring(const SpringOptions& options, double length) {
  joints::PointSpring::Parameters parameters = options.law;
  parameters.free_length = options.free_length.value_or(length);
  return joints::PointSpring(parameters);
}

joints::Latch make_latch(const Latch& latch, const JointParameters& held) {
  joints::Latch::Parameters parameters;
  parameters.reach = latch.reach;
  parameters.bushing = joints::make_joint_bushing(joints::JointKind::fixed,
                                                  Vector3::UnitX(), held)
                           .parameters();
  parameters.release_force = latch.release_force;
  parameters.release_time = latch.release_time;
  return joints::Latch(parameters);
}

std::vector<ScalarLaw> make_tendon_laws(const Tendon& tendon, double length) {
  std::vector<ScalarLaw> laws;
  if (tendon.stiffness > 0.0 || tendon.damping > 0.0) {
    double rest = tendon.free_length.value_or(length);
    if (tendon.pretension) rest -= *tendon.pretension / tendon.stiffness;
    laws.emplace_back(
        make_linear(tendon.stiffness, tendon.damping, rest, true));
  }
  if (tendon.tension > 0.0) {
    Drive::Parameters pull;
    pull.mode = joints::DriveMode::effort;
    pull.signal.base = joints::ConstantSignal{tendon.tension};
    pull.pulls_only = true;
    laws.emplace_back(Drive(pull));
  }
  return laws;
}

ScalarSpring make_gear_spring(const Gear& gear, const Constraint& joint,
                              const Constraint& with) {
  const double square = gear.ratio * gear.ratio;
  const Constraint other{with.stiffness / square, with.damping / square};
  const Constraint& softer = other.stiffness < joint.stiffness ? other : joint;
  return make_linear(gear.stiffness.value_or(softer.stiffness),
                     gear.damping.value_or(softer.damping), 0.0, false);
}

}  // namespace limber::scene
