// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/integrators/finite_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

double measure_state(const SystemModel& model, const SystemState& state,
                     std::size_t b) {
  const BodyModel& body = model.bodies[b];
  if (body.full >= 0) {
    const FullModel& full =
        model.full_bodies[static_cast<std::size_t>(body.full)];
    return state.u_H.segment(full.first, full.dofs()).squaredNorm();
  }
  return state.bodies[b].p_WB.squaredNorm() +
         state.bodies[b].w_WB_B.squaredNorm() +
         state.eta.segment(body.offset, body.modes).squaredNorm();
}

}  // namespace

void require_finite(const SystemModel& model, const SystemState& state,
                    double h) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    if (std::isfinite(measure_state(model, state, b))) continue;
    throw NumericalError(fmt::format(
        "body '{}' at t = {:.9g} s: its motion is no longer finite; the "
        "explicit step {:.3g} s is too long for its stiffest mode or coupler",
        model.bodies[b].name, state.t, h));
  }
}

}  // namespace limber::dynamics
