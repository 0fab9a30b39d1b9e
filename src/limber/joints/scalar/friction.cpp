// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/friction.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::joints {
namespace {

void check_value(bool holds, const char* what, double value,
                 const char* expected) {
  if (holds && std::isfinite(value)) return;
  throw InputError(fmt::format("friction: its {} is {:g}; expected {}", what,
                               value, expected));
}

}  // namespace

Friction::Friction(const Parameters& parameters) : parameters_(parameters) {
  const Parameters& p = parameters;
  check_value(p.coulomb >= 0.0, "Coulomb force", p.coulomb, ">= 0");
  check_value(p.viscous >= 0.0, "viscous coefficient", p.viscous, ">= 0");
  check_value(p.speed > 0.0, "smoothing speed", p.speed, "> 0");
}

ScalarResponse Friction::evaluate(const ScalarMotion& motion,
                                  const EvaluationTime& /*now*/,
                                  const SwitchModes& /*modes*/) const {
  const Parameters& p = parameters_;
  const double v = motion.rate;
  const double speed = std::hypot(v, p.speed);
  const double force = -p.coulomb * v / speed - p.viscous * v;
  const double fraction = p.speed / speed;
  return {.force = force,
          .dissipation = -force * v,
          .damping = p.coulomb * fraction * fraction / speed + p.viscous};
}

ScalarResponse Friction::evaluate_over_step(const CoordinateStep& coordinate,
                                            const StepTimes& times,
                                            const SwitchModes& modes) const {
  return balance(evaluate_ends(*this, coordinate, times, modes), coordinate,
                 times.h);
}

}  // namespace limber::joints
