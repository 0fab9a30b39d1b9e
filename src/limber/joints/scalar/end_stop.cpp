// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/end_stop.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/restitution.hpp"

namespace limber::joints {
namespace {

// Beyond a bound by d > 0 with the rate v of d; the force opposes d.
ScalarResponse press(const EndStop::Parameters& p, double d, double v) {
  const double grip = 1.0 + p.damping * v;
  const double spring = p.stiffness * d;
  if (grip <= 0.0) {
    return {.energy = 0.5 * spring * d, .dissipation = -spring * v};
  }
  return {.force = -spring * grip,
          .energy = 0.5 * spring * d,
          .dissipation = spring * p.damping * v * v,
          .stiffness = p.stiffness * grip,
          .damping = spring * p.damping};
}

}  // namespace

EndStop::EndStop(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters;
  if (!(p.lower <= p.upper) || p.lower == kUnbounded ||
      p.upper == -kUnbounded) {
    throw InputError(
        fmt::format("end stop: nothing is within its bounds {:g} and {:g}; "
                    "expected lower <= upper",
                    p.lower, p.upper));
  }
  if (!(p.stiffness > 0.0) || !std::isfinite(p.stiffness)) {
    throw InputError(fmt::format(
        "end stop: its stiffness is {:g}; expected > 0", p.stiffness));
  }
  if (!(p.damping >= 0.0) || !std::isfinite(p.damping)) {
    throw InputError(
        fmt::format("end stop: its damping is {:g}; expected >= 0", p.damping));
  }
}

ScalarResponse EndStop::evaluate(const ScalarMotion& motion,
                                 const SwitchModes& modes) const {
  const Parameters& p = parameters_;
  if (is_on(modes[0], motion.z > p.upper)) {
    return press(p, motion.z - p.upper, motion.rate);
  }
  if (is_on(modes[1], motion.z < p.lower)) {
    ScalarResponse response = press(p, p.lower - motion.z, -motion.rate);
    response.force = -response.force;
    return response;
  }
  return {};
}

SwitchValue EndStop::find_switch(int index, const ScalarMotion& motion) const {
  if (index == 0) return {motion.z - parameters_.upper, motion.rate};
  return {parameters_.lower - motion.z, -motion.rate};
}

ScalarResponse EndStop::evaluate_over_step(const CoordinateStep& coordinate,
                                           const StepTimes& times,
                                           const SwitchModes& modes) const {
  return balance(evaluate_ends(*this, coordinate, times, modes), coordinate,
                 times.h);
}

std::optional<BeyondBound> EndStop::find_beyond_bound(
    const ScalarMotion& motion) const {
  const Parameters& p = parameters_;
  const double z = motion.z;
  const bool is_above = z > p.upper;
  if (!is_above && !(z < p.lower)) return std::nullopt;
  const double bound = is_above ? p.upper : p.lower;
  return BeyondBound{.bound = bound,
                     .by = is_above ? z - bound : bound - z,
                     .energy = evaluate(motion).energy};
}

double find_stop_damping(double restitution, double speed) {
  if (!(restitution > 0.0) || !(restitution <= 1.0)) {
    throw InputError(fmt::format(
        "end stop: its restitution is {:g}; expected more than 0, at most 1",
        restitution));
  }
  if (!(speed > 0.0) || !std::isfinite(speed)) {
    throw InputError(fmt::format(
        "end stop: the speed of its restitution is {:g}; expected > 0", speed));
  }
  return find_restitution_damping(restitution, speed);
}

}  // namespace limber::joints
