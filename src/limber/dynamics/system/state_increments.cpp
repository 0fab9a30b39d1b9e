// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/system/state_increments.hpp"

#include "limber/common/rotation.hpp"

namespace limber::dynamics {

void displace(const SystemModel& model, const VectorX& increments,
              double fraction, SystemState& state) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    state.eta.segment(body.offset, body.modes) +=
        fraction * mode_rows(body, increments);
    if (!body.has_rigid_motion()) continue;
    BodyState& rigid = state.bodies[b];
    rigid.p_WB += fraction * translation_rows(body, increments);
    const Vector3 rotation = fraction * rotation_rows(body, increments);
    rigid.quat_WB = (rigid.quat_WB * exp_quaternion(rotation)).normalized();
  }
  state.u_H += fraction * nodal_rows(model, increments);
}

VectorX find_increments(const SystemModel& model, const SystemState& from,
                        const SystemState& to) {
  VectorX increments = make_unknowns(model);
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    mode_rows(body, increments) = to.eta.segment(body.offset, body.modes) -
                                  from.eta.segment(body.offset, body.modes);
    if (!body.has_rigid_motion()) continue;
    const BodyState& a = from.bodies[b];
    const BodyState& z = to.bodies[b];
    translation_rows(body, increments) = z.p_WB - a.p_WB;
    rotation_rows(body, increments) =
        log_rotation((a.quat_WB.conjugate() * z.quat_WB).toRotationMatrix());
  }
  nodal_rows(model, increments) = to.u_H - from.u_H;
  return increments;
}

void get_velocities(const SystemModel& model, const SystemState& state,
                    VectorX& velocities) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    mode_rows(body, velocities) = state.etadot.segment(body.offset, body.modes);
    if (!body.has_rigid_motion()) continue;
    translation_rows(body, velocities) = state.bodies[b].v_WB_W;
    rotation_rows(body, velocities) = state.bodies[b].w_WB_B;
  }
  nodal_rows(model, velocities) = state.udot_H;
}

void set_velocities(const SystemModel& model, const VectorX& velocities,
                    SystemState& state) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    state.etadot.segment(body.offset, body.modes) = mode_rows(body, velocities);
    if (!body.has_rigid_motion()) continue;
    state.bodies[b].v_WB_W = translation_rows(body, velocities);
    state.bodies[b].w_WB_B = rotation_rows(body, velocities);
  }
  state.udot_H = nodal_rows(model, velocities);
}

}  // namespace limber::dynamics
