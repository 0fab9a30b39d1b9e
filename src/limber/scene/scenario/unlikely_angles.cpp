// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_angles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/overloaded.hpp"

namespace limber::scene {
namespace {

constexpr double kRound = 2.0 * std::numbers::pi;

void question_orientation(const std::string& who, const Vector3& rpy,
                          std::vector<std::string>& questions) {
  constexpr double kRounded = 1.001;  // 6.2832 is one turn
  const double angle = rpy.cwiseAbs().maxCoeff();
  if (angle <= kRounded * kRound) return;
  questions.push_back(
      fmt::format("{}: orientation_rpy has {:g} rad, {:.1f} turns; is it in "
                  "radians?",
                  who, angle, angle / kRound));
}

void question_orientations(const Scenario& scenario,
                           std::vector<std::string>& questions) {
  question_orientation("[initial.base]", scenario.base.orientation_rpy,
                       questions);
  for (const RobotSpec& robot : scenario.robots) {
    question_orientation(fmt::format("robot '{}'", robot.name),
                         robot.start.orientation_rpy, questions);
  }
  for (const ProjectileSpec& body : scenario.projectiles) {
    question_orientation(fmt::format("projectile '{}'", body.name),
                         body.start.orientation_rpy, questions);
  }
  for (const ObstacleSpec& obstacle : scenario.obstacles) {
    question_orientation(fmt::format("obstacle '{}'", obstacle.name),
                         obstacle.orientation_rpy, questions);
  }
}

void question_start(const Joint& joint, const JointStart& start,
                    std::vector<std::string>& questions) {
  for (std::size_t i = 0; i < start.position.size(); ++i) {
    const double angle = start.position[i];
    if (std::abs(angle) > kRound) {
      questions.push_back(
          fmt::format("joint '{}' starts at {:g} rad, {:.1f} turns; is it in "
                      "radians?",
                      joint.name, angle, angle / kRound));
    } else if (fits_as_degrees(joint.actions, static_cast<int>(i), angle)) {
      questions.push_back(fmt::format(
          "joint '{}' starts at {:g} rad, beyond its stop, where {:g} degrees "
          "are within it; is it in radians?",
          joint.name, angle, angle));
    }
  }
}

/// The largest magnitude of a joint's stops [rad].
double find_range(const Joint& joint) {
  double range = 0.0;
  for (const JointAction& action : joint.actions) {
    const auto* stop = std::get_if<StopOptions>(&action.law);
    if (stop == nullptr) continue;
    range = std::max({range, std::abs(stop->lower.value_or(0.0)),
                      std::abs(stop->upper.value_or(0.0))});
  }
  return range;
}

/// Whether a scene uses more than one turn of a joint, or a gear joins it.
bool turns_much(const Joint& joint, const Scenario& scenario,
                const Robot& robot) {
  const auto start = scenario.joints.find(joint.name);
  const bool starts_far =
      start != scenario.joints.end() &&
      std::any_of(start->second.position.begin(), start->second.position.end(),
                  [](double angle) { return std::abs(angle) > kRound; });
  const auto commands_far = [&](const DriveSpec& drive) {
    if (drive.joint != joint.name) return false;
    if (drive.drive.mode == joints::DriveMode::velocity) return true;
    return drive.drive.mode == joints::DriveMode::position &&
           std::abs(find_extreme(drive.drive.signal).value_or(0.0)) > kRound;
  };
  const auto is_joined = [&](const Gear& gear) {
    return gear.joint == joint.name || gear.with == joint.name;
  };
  return starts_far ||
         std::any_of(scenario.drives.begin(), scenario.drives.end(),
                     commands_far) ||
         std::any_of(robot.gears.begin(), robot.gears.end(), is_joined);
}

void question_stops(const Joint& joint, const Scenario& scenario,
                    const Robot& robot, std::vector<std::string>& questions) {
  const double range = find_range(joint);
  if (range <= 2.0 * kRound || turns_much(joint, scenario, robot)) return;
  questions.push_back(
      fmt::format("joint '{}' has a stop at {:g} rad, {:.1f} turns; is its "
                  "<limit> in radians?",
                  joint.name, range, range / kRound));
}

}  // namespace

bool has_angles_alone(joints::JointKind kind) {
  using enum joints::JointKind;
  return kind == revolute || kind == continuous || kind == universal;
}

bool fits_as_degrees(const std::vector<JointAction>& actions, int coordinate,
                     double angle, double beyond) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  bool is_beyond = false;
  bool fits = true;
  for (const JointAction& action : actions) {
    const auto* stop = std::get_if<StopOptions>(&action.law);
    if (stop == nullptr || action.coordinate != coordinate) continue;
    const auto is_within = [&](double value, double margin) {
      return value >= stop->lower.value_or(value) - margin &&
             value <= stop->upper.value_or(value) + margin;
    };
    is_beyond = is_beyond || !is_within(angle, beyond);
    fits = fits && is_within(angle * kDegree, 0.0);
  }
  return is_beyond && fits;
}

std::optional<double> find_extreme(const joints::Signal& signal) {
  const auto choose = [](double a, double b) {
    return std::abs(a) > std::abs(b) ? a : b;
  };
  return std::visit(
      Overloaded{[](const joints::ConstantSignal& s) -> std::optional<double> {
                   return s.value;
                 },
                 [&](const joints::RampSignal& s) -> std::optional<double> {
                   return choose(s.to, s.from);
                 },
                 [&](const joints::TableSignal& s) -> std::optional<double> {
                   double extreme = 0.0;
                   for (const double value : s.values) {
                     extreme = choose(value, extreme);
                   }
                   return extreme;
                 },
                 [&](const joints::SineSignal& s) -> std::optional<double> {
                   return choose(s.mean + s.amplitude, s.mean - s.amplitude);
                 },
                 [](const joints::InputSignal&) -> std::optional<double> {
                   return std::nullopt;
                 }},
      signal.base);
}

std::vector<std::string> question_angles(const Scenario& scenario,
                                         const Robot& robot) {
  std::vector<std::string> questions;
  question_orientations(scenario, questions);
  for (const Joint& joint : robot.joints) {
    if (!has_angles_alone(joint.kind)) continue;
    const auto start = scenario.joints.find(joint.name);
    if (start != scenario.joints.end()) {
      question_start(joint, start->second, questions);
    }
    question_stops(joint, scenario, robot, questions);
  }
  return questions;
}

}  // namespace limber::scene
