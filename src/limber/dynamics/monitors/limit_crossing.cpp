// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/monitors/limit_crossing.hpp"

namespace limber::dynamics {
namespace {

using joints::ScalarMotion;

// A crossing nearer to an end of the step does no harm there, and a step that
// was cut at one begins beside it [-].
constexpr double kNearEnd = 0.02;
constexpr int kLooks = 8;
constexpr int kBisections = 30;

enum class Grip { slack, free, at_upper, at_lower };

// A drive within one step of h [s] from `start`.
struct DriveStep {
  const PlacedDrive& drive;
  EvaluationTime start;
  double h;
  ScalarMotion a, b;  // at its ends

  [[nodiscard]] ScalarMotion interpolate(double s) const {
    const double rise = b.z - a.z;
    const double left = 1.0 - s;
    const double z = a.z + s * s * (3.0 - 2.0 * s) * rise +
                     h * s * left * (left * a.rate - s * b.rate);
    const double rate = 6.0 * s * left * rise / h +
                        left * (1.0 - 3.0 * s) * a.rate +
                        s * (3.0 * s - 2.0) * b.rate;
    return {z, rate};
  }

  [[nodiscard]] Grip find_grip(double s) const {
    EvaluationTime now = start;
    now.t += s * h;
    const ScalarMotion motion = interpolate(s);
    const double load = joints::find_load(*drive.law, motion, now);
    if (load >= 1.0) {
      const double force = joints::evaluate(*drive.law, motion, now).force;
      return force > 0.0 ? Grip::at_upper : Grip::at_lower;
    }
    return drive.pulls_only && load <= 0.0 ? Grip::slack : Grip::free;
  }

  [[nodiscard]] double bisect(double low, double high, Grip at_low) const {
    for (int i = 0; i < kBisections; ++i) {
      const double middle = 0.5 * (low + high);
      (find_grip(middle) == at_low ? low : high) = middle;
    }
    return high;
  }

  [[nodiscard]] std::optional<double> find_change(double until) const {
    double low = kNearEnd;
    const Grip first = find_grip(low);
    for (int i = 1; i <= kLooks && low < until; ++i) {
      const double high = kNearEnd + (1.0 - 2.0 * kNearEnd) * i / kLooks;
      if (find_grip(high) != first) return bisect(low, high, first);
      low = high;
    }
    return std::nullopt;
  }
};

}  // namespace

LimitCrossing::LimitCrossing(const SystemModel& model)
    : model_(model), drives_(find_limited_drives(model)) {}

std::optional<double> LimitCrossing::find_first(
    const SystemState& before, const SystemState& after) const {
  std::optional<double> first;
  for (const PlacedDrive& drive : drives_) {
    const DriveStep step{drive, now_of(before), after.t - before.t,
                         find_motion(model_, before, drive),
                         find_motion(model_, after, drive)};
    const auto change = step.find_change(first.value_or(1.0));
    if (change && (!first || *change < *first)) first = change;
  }
  return first;
}

}  // namespace limber::dynamics
