// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/scalar_spring.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {

ScalarSpring::ScalarSpring(const Parameters& parameters)
    : parameters_(parameters) {
  if (!(parameters.damping >= 0.0) || !std::isfinite(parameters.damping)) {
    throw InputError(fmt::format("spring: its damping is {:g}; expected >= 0",
                                 parameters.damping));
  }
  if (!std::isfinite(parameters.rest)) {
    throw InputError("spring: its rest position is not finite");
  }
  const double push = -parameters.curve.evaluate(0.0).force;
  if (parameters.tension_only && push > 0.0) {
    throw InputError(fmt::format(
        "spring: it only pulls, but its table pushes with {:g} at extension 0; "
        "expected a force >= 0 there",
        push));
  }
}

ScalarResponse ScalarSpring::evaluate(const ScalarMotion& motion,
                                      const SwitchModes& modes) const {
  const double s = motion.z - parameters_.rest;
  if (parameters_.tension_only && !is_on(modes[0], s > 0.0)) return {};
  const SpringCurve::Point point = parameters_.curve.evaluate(s);
  const double c = parameters_.damping;
  const double pull = point.force + c * motion.rate;
  if (parameters_.tension_only && pull < 0.0) {
    return {.energy = point.energy, .dissipation = -point.force * motion.rate};
  }
  return {.force = -pull,
          .energy = point.energy,
          .dissipation = c * motion.rate * motion.rate,
          .stiffness = point.slope,
          .damping = c};
}

SwitchValue ScalarSpring::find_switch(int /*index*/,
                                      const ScalarMotion& motion) const {
  return {motion.z - parameters_.rest, motion.rate};
}

ScalarResponse ScalarSpring::evaluate_over_step(
    const CoordinateStep& coordinate, const StepTimes& times,
    const SwitchModes& modes) const {
  return balance(evaluate_ends(*this, coordinate, times, modes), coordinate,
                 times.h);
}

}  // namespace limber::joints
