// SPDX-License-Identifier: BSD-3-Clause
#include "joints/end_stop.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/errors.hpp"

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
  const double e = restitution;
  if (e == 1.0) return 0.0;
  // What the bounce leaves too fast (> 0) or too slow, for beta in (0, 1/e).
  const auto excess = [e](double beta) {
    return (1.0 + e) * beta - std::log1p(beta) + std::log1p(-e * beta);
  };
  double low = 0.0;
  double high = 1.0 / e;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high) / speed;
}

}  // namespace limber::joints
