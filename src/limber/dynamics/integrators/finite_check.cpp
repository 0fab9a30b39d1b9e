// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/finite_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/dynamics/bodies/body.hpp"

namespace limber::dynamics {

void require_finite(const SystemModel& model, const SystemState& state,
                    double h) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const double size = visit_body(
        model, b, [&](const auto& own) { return own.measure_state(state); });
    if (std::isfinite(size)) continue;
    throw NumericalError(fmt::format(
        "body '{}' at t = {:.9g} s: its motion is no longer finite; the "
        "explicit step {:.3g} s is too long for its stiffest mode or coupler",
        model.bodies[b].name, state.t, h));
  }
}

}  // namespace limber::dynamics
