// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/drive_gain.hpp"

#include <algorithm>
#include <cmath>

namespace limber::joints {
namespace {

// The fraction of its command that an effort drive exerts beyond its speed.
DriveGain find_effort_gain(const Drive::Parameters& p,
                           const ScalarMotion& motion, double command) {
  const double low = p.pulls_only ? 0.0 : -p.max_effort;
  if (command < low || command > p.max_effort) return {};
  const double sign = p.pulls_only ? -1.0 : 1.0;
  const double speed = std::copysign(1.0, sign * command) * motion.rate;
  const double band = (Drive::kOverspeed - 1.0) * p.max_speed;
  const double fraction =
      speed > p.max_speed ? 1.0 - (speed - p.max_speed) / band : 1.0;
  return {sign * std::max(0.0, fraction), 0.0};
}

}  // namespace

DriveGain find_gain(const Drive& drive, const ScalarMotion& motion,
                    const EvaluationTime& now) {
  const Drive::Parameters& p = drive.parameters();
  const SignalValue command = evaluate(p.signal, now);
  if (p.mode == DriveMode::effort) {
    return find_effort_gain(p, motion, command.value);
  }
  const ScalarResponse response = drive.evaluate(motion, now);
  if (p.mode == DriveMode::position) {
    return {response.stiffness, response.damping};
  }
  if (std::abs(command.value) > p.max_speed) return {};
  return {response.damping, 0.0};
}

}  // namespace limber::joints
