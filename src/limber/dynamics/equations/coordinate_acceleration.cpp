// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/coordinate_acceleration.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {

double find_coordinate_acceleration(
    const SystemModel& model, const SystemState& state,
    const SystemTerms& terms, CouplerIndex coupler, std::size_t coordinate,
    VectorX& accelerations, SystemState& moving) {
  solve_accelerations(model, terms, accelerations);
  moving = state;  // with accelerations for velocities
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    moving.bodies[b].v_WB_W = translation_rows(body, accelerations);
    moving.bodies[b].w_WB_B = rotation_rows(body, accelerations);
    moving.etadot.segment(body.offset, body.modes) =
        mode_rows(body, accelerations);
  }
  const auto& coordinates =
      joints::coordinates_of(model.couplers[index(coupler)].law);
  return joints::evaluate(coordinates[coordinate],
                          find_relative_motion(model, moving, coupler),
                          moving.memory[index(coupler)].near[coordinate])
      .rate;
}

}  // namespace limber::dynamics
