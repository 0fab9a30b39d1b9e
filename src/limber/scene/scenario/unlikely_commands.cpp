// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/scenario/unlikely_commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "limber/scene/scenario/unlikely_angles.hpp"

namespace limber::scene {
namespace {

using joints::DriveMode;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A joint or loop of the robot.
struct Driven {
  joints::JointKind kind = joints::JointKind::fixed;
  const std::vector<JointAction>* actions = nullptr;
  double max_effort = joints::Drive::kUnlimited;  ///< [N or N m]
  double max_speed = joints::Drive::kUnlimited;   ///< [m/s or rad/s]
};

std::optional<Driven> find_driven(const Robot& robot, const std::string& name) {
  for (const Joint& joint : robot.joints) {
    if (joint.name != name) continue;
    return Driven{joint.kind, &joint.actions, joint.max_effort,
                  joint.max_speed};
  }
  for (const Loop& loop : robot.loops) {
    if (loop.name == name) return Driven{loop.kind, &loop.actions};
  }
  return std::nullopt;
}

bool is_within_stops(const Driven& driven, double angle) {
  return std::any_of(driven.actions->begin(), driven.actions->end(),
                     [&](const JointAction& action) {
                       const auto* stop = std::get_if<StopOptions>(&action.law);
                       return stop != nullptr &&
                              std::max(std::abs(stop->lower.value_or(0.0)),
                                       std::abs(stop->upper.value_or(0.0))) >=
                                  angle;
                     });
}

/// What is said of a command's angle that hardly anyone means: "30 rad, 4.8
/// turns". Commands a little beyond a stop press against it.
std::optional<std::string> describe_unlikely_angle(
    const joints::Signal& signal, const std::optional<Driven>& driven,
    int coordinate) {
  constexpr double kBeyond = 1.0;  // [rad]
  if (!driven || !has_angles_alone(driven->kind)) return std::nullopt;
  const double angle = joints::find_largest(signal).value;
  if (std::isfinite(angle) && angle > kTurn &&
      !is_within_stops(*driven, angle)) {
    return fmt::format("{:g} rad, {:.1f} turns", angle, angle / kTurn);
  }
  const std::optional<double> extreme = find_extreme(signal);
  if (!extreme ||
      !fits_as_degrees(*driven->actions, coordinate, *extreme, kBeyond)) {
    return std::nullopt;
  }
  return fmt::format(
      "{:g} rad, beyond its stop, where {:g} degrees are within it", *extreme,
      *extreme);
}

/// Of a sine. @param who "drive 'x'" or "controller 'x'"
void question_phase(const std::string& who, const joints::Signal& signal,
                    std::vector<std::string>& questions) {
  const auto* sine = std::get_if<joints::SineSignal>(&signal.base);
  if (sine == nullptr || std::abs(sine->phase) <= kTurn) return;
  questions.push_back(
      fmt::format("{}: the phase of its sine is {:g} rad; is it in radians?",
                  who, sine->phase));
}

void question_drive(const DriveSpec& drive, const Robot& robot,
                    std::vector<std::string>& questions) {
  const std::string who = "drive '" + drive.name + "'";
  question_phase(who, drive.drive.signal, questions);
  if (drive.drive.mode != DriveMode::position) return;
  const auto angle = describe_unlikely_angle(drive.drive.signal,
                                             find_driven(robot, drive.joint),
                                             drive.coordinate - 1);
  if (!angle) return;
  questions.push_back(
      fmt::format("{} commands joint '{}' up to {}; is its signal in radians?",
                  who, drive.joint, *angle));
}

/// The joint whose coordinate a controller measures; empty: none.
std::string find_measured_joint(const ControllerSpec& controller,
                                const Scenario& scenario) {
  const std::string name =
      controller.measures.substr(0, controller.measures.rfind('.'));
  for (const ProbeSpec& probe : scenario.probes) {
    const auto* coupler = std::get_if<CouplerProbeSpec>(&probe.of);
    if (probe.name != name || coupler == nullptr) continue;
    return coupler->quantity == CouplerQuantity::coordinate ? coupler->coupler
                                                            : "";
  }
  return "";
}

/// From 0: that of "angle.q2" is 1.
int find_measured_coordinate(const ControllerSpec& controller) {
  const char last =
      controller.measures.empty() ? '1' : controller.measures.back();
  return last >= '1' && last <= '9' ? last - '1' : 0;
}

void question_controller(const ControllerSpec& controller,
                         const Scenario& scenario, const Robot& robot,
                         std::vector<std::string>& questions) {
  const std::string who = "controller '" + controller.name + "'";
  const joints::Signal& reference = controller.pid.reference;
  question_phase(who, reference, questions);
  const std::string joint = find_measured_joint(controller, scenario);
  const int coordinate = find_measured_coordinate(controller);
  if (const auto angle = describe_unlikely_angle(
          reference, find_driven(robot, joint), coordinate)) {
    questions.push_back(fmt::format(
        "{} has a reference for joint '{}' of up to {}; is it in radians?", who,
        joint, *angle));
  }
  const double end = scenario.settings.end_time;
  if (controller.pid.period <= end) return;
  questions.push_back(fmt::format(
      "{} has a period of {:g} s, longer than the run of {:g} s, in which it "
      "is sampled once; is its period in seconds?",
      who, controller.pid.period, end));
}

/// What a drive exerts or commands at most, by its mode.
struct DriveLimit {
  double value = joints::Drive::kUnlimited;
  const char* key = "";
  const char* unit = "";
};

DriveLimit find_limit(const DriveSpec& drive, const Robot& robot) {
  const Driven driven = find_driven(robot, drive.joint).value_or(Driven{});
  const bool rotates = has_angles_alone(driven.kind);
  const auto choose = [](double own, double of_joint) {
    return std::isinf(own) ? of_joint : own;
  };
  if (drive.drive.mode == DriveMode::effort) {
    return {choose(drive.drive.max_effort, driven.max_effort), "max_effort",
            rotates ? "N m" : "N"};
  }
  if (drive.drive.mode == DriveMode::velocity) {
    return {choose(drive.drive.max_speed, driven.max_speed), "max_speed",
            rotates ? "rad/s" : "m/s"};
  }
  return {};
}

/// The drive saturates first, and the controller's integral does not stop.
void question_limits(const DriveSpec& drive, const Scenario& scenario,
                     const Robot& robot, std::vector<std::string>& questions) {
  const auto* input =
      std::get_if<joints::InputSignal>(&drive.drive.signal.base);
  if (input == nullptr) return;
  const ControllerSpec& controller =
      scenario.controllers.at(static_cast<std::size_t>(input->input));
  const DriveLimit limit = find_limit(drive, robot);
  const double factor = std::abs(input->factor);
  const double reach = factor * std::max(std::abs(controller.pid.lower),
                                         std::abs(controller.pid.upper));
  if (!std::isfinite(reach) || !(reach > limit.value)) return;
  questions.push_back(fmt::format(
      "controller '{}' may ask drive '{}' for {:g} {}, and its {} is {:g} {}: "
      "the drive saturates before the controller's 'limits', beyond which its "
      "integral stops; use limits within +-{:g}",
      controller.name, drive.name, reach, limit.unit, limit.key, limit.value,
      limit.unit, limit.value / factor));
}

}  // namespace

std::vector<std::string> question_commands(const Scenario& scenario,
                                           const Robot& robot) {
  std::vector<std::string> questions;
  for (const DriveSpec& drive : scenario.drives) {
    question_drive(drive, robot, questions);
    question_limits(drive, scenario, robot, questions);
  }
  for (const ControllerSpec& controller : scenario.controllers) {
    question_controller(controller, scenario, robot, questions);
  }
  for (const LoadSpec& load : scenario.loads) {
    const auto* sine = std::get_if<dynamics::Sinusoid>(&load.time);
    if (sine == nullptr || std::abs(sine->phase) <= kTurn) continue;
    questions.push_back(fmt::format(
        "load '{}': the phase of its sinusoid is {:g} rad; is it in radians?",
        load.name, sine->phase));
  }
  return questions;
}

}  // namespace limber::scene
