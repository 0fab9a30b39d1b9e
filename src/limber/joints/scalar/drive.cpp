// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

void require_of_drive(bool holds, const std::string& text) {
  if (!holds) throw InputError("drive: " + text);
}

void check_limits(const Drive::Parameters& p) {
  require_of_drive(
      p.max_effort > 0.0,
      fmt::format("its largest effort is {:g}; expected > 0", p.max_effort));
  require_of_drive(
      p.max_speed > 0.0,
      fmt::format("its largest speed is {:g}; expected > 0", p.max_speed));
  if (!find_inputs(p.signal).empty()) {
    require_of_drive(
        p.mode != DriveMode::position || p.max_speed == Drive::kUnlimited,
        "it follows an input, which may jump, and limits its speed; leave "
        "the limit out, or limit the rate in the controller");
    return;
  }
  const SignalValue command = find_largest(p.signal);
  constexpr double kSlack = 1.0 + 1e-9;
  const double speed = p.mode == DriveMode::position   ? command.rate
                       : p.mode == DriveMode::velocity ? command.value
                                                       : 0.0;
  require_of_drive(
      speed <= p.max_speed * kSlack,
      fmt::format("its signal commands a speed of {:g}; its limit is {:g}",
                  speed, p.max_speed));
  require_of_drive(
      p.mode != DriveMode::effort || command.value <= p.max_effort * kSlack,
      fmt::format("its signal commands an effort of {:g}; its limit is "
                  "{:g}",
                  command.value, p.max_effort));
}

}  // namespace

Drive::Drive(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters;
  check(p.signal);
  require_of_drive(
      p.stiffness >= 0.0 && std::isfinite(p.stiffness) &&
          (p.stiffness > 0.0 || p.mode != DriveMode::position),
      fmt::format("its stiffness is {:g}; expected >= 0, of a position "
                  "drive > 0",
                  p.stiffness));
  require_of_drive(
      p.damping >= 0.0 && std::isfinite(p.damping) &&
          (p.damping > 0.0 || p.mode != DriveMode::velocity),
      fmt::format("its damping is {:g}; expected >= 0, of a velocity drive "
                  "> 0",
                  p.damping));
  check_limits(p);
}

// Command of the signal; inputs are clipped to the speed limit here.
SignalValue Drive::find_command(const EvaluationTime& now) const {
  const Parameters& p = parameters_;
  SignalValue command = joints::evaluate(p.signal, now);
  if (p.mode == DriveMode::velocity &&
      !(std::abs(command.value) <= p.max_speed) &&
      std::holds_alternative<InputSignal>(p.signal.base)) {
    command = {std::copysign(p.max_speed, command.value), 0.0};
  }
  return command;
}

Drive::Clipped Drive::clip(double pull) const {
  const double low = parameters_.pulls_only ? 0.0 : -parameters_.max_effort;
  const double high = parameters_.max_effort;
  return {std::clamp(pull, low, high), pull > low && pull < high};
}

// Integral of clip(k e) from e = 0 [J].
double Drive::clipped_energy(double error) const {
  const double pull = clip(parameters_.stiffness * error).value;
  return pull * error - 0.5 * pull * pull / parameters_.stiffness;
}

ScalarResponse Drive::push(const ScalarMotion& motion, double effort) const {
  const Parameters& p = parameters_;
  const double force = p.pulls_only ? -clip(effort).value : clip(effort).value;
  ScalarResponse response{.force = force};
  const double speed = std::copysign(1.0, force) * motion.rate;
  if (speed > p.max_speed) {
    const double band = (kOverspeed - 1.0) * p.max_speed;
    const double fraction = 1.0 - (speed - p.max_speed) / band;
    response.force = force * std::max(0.0, fraction);
    response.damping = fraction > 0.0 ? std::abs(force) / band : 0.0;
  }
  response.supplied = response.force * motion.rate;
  return response;
}

ScalarResponse Drive::evaluate(const ScalarMotion& motion,
                               const EvaluationTime& now,
                               const SwitchModes& /*modes*/) const {
  const Parameters& p = parameters_;
  const SignalValue command = find_command(now);
  if (p.mode == DriveMode::effort) return push(motion, command.value);
  const bool is_position = p.mode == DriveMode::position;
  const double target_rate = is_position ? command.rate : command.value;
  const double k = is_position ? p.stiffness : 0.0;
  const double error = is_position ? motion.z - command.value : 0.0;
  const double error_rate = motion.rate - target_rate;

  const Clipped pull = clip(k * error + p.damping * error_rate);
  ScalarResponse response{.force = -pull.value,
                          .supplied = -pull.value * target_rate};
  const double spring = clip(k * error).value;
  if (is_position) response.energy = clipped_energy(error);
  response.dissipation = (pull.value - spring) * error_rate;
  if (pull.is_free) {
    response.stiffness = k;
    response.damping = p.damping;
  }
  return response;
}

ScalarResponse Drive::evaluate_over_step(const CoordinateStep& coordinate,
                                         const StepTimes& times,
                                         const SwitchModes& modes) const {
  const ScalarStep step = evaluate_ends(*this, coordinate, times, modes);
  ScalarResponse response = step.response;
  response.supplied = (step.energy1 - step.energy0) / times.h +
                      response.dissipation + response.force * coordinate.rate;
  return response;
}

std::vector<double> Drive::break_times() const {
  return joints::break_times(parameters_.signal);
}

std::vector<int> Drive::find_inputs() const {
  return joints::find_inputs(parameters_.signal);
}

double Drive::find_target_rate(const EvaluationTime& now) const {
  const SignalValue command = find_command(now);
  switch (parameters_.mode) {
    case DriveMode::position:
      return command.rate;
    case DriveMode::velocity:
      return command.value;
    case DriveMode::effort:
      break;
  }
  return 0.0;
}

double Drive::find_load(const ScalarMotion& motion,
                        const EvaluationTime& now) const {
  const Parameters& p = parameters_;
  if (p.mode == DriveMode::effort) return 0.0;
  const SignalValue command = find_command(now);
  const double pull = p.mode == DriveMode::velocity
                          ? p.damping * (motion.rate - command.value)
                          : p.stiffness * (motion.z - command.value) +
                                p.damping * (motion.rate - command.rate);
  return (p.pulls_only ? std::max(pull, 0.0) : std::abs(pull)) / p.max_effort;
}

std::optional<Supply> Drive::find_supply(const ScalarMotion& motion,
                                         const EvaluationTime& now) const {
  const Parameters& p = parameters_;
  const ScalarResponse response = evaluate(motion, now);
  const SignalValue command = find_command(now);
  switch (p.mode) {
    case DriveMode::position:
      return Supply{response.force, command.value, command.rate};
    case DriveMode::velocity:
      if (const auto place = integrate(p.signal, now.t)) {
        return Supply{response.force, *place, command.value};
      }
      return {};
    case DriveMode::effort:
      break;
  }
  return Supply{response.force, motion.z, motion.rate};
}

}  // namespace limber::joints
