// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/probes/point_probe.hpp"

#include "limber/common/rotation.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

namespace limber::scene {
namespace {

/// The motion of a probe's point and frame in the world, or in its base.
struct Motion {
  Vector3 p_W;                    ///< [m]
  Vector3 v_W;                    ///< [m/s]
  Matrix3 R_W;                    ///< of the deformed frame
  Vector3 w_W;                    ///< [rad/s]
  Vector3 u_B = Vector3::Zero();  ///< deformation, if requested [m]
};

Motion find_modal_motion(const PointProbe& probe,
                         const dynamics::BodyModel& body,
                         const dynamics::BodyState& rigid,
                         const dynamics::SystemState& state) {
  Motion motion;
  Vector3 udot_B = Vector3::Zero();
  Vector3 rotation_B = Vector3::Zero();
  Vector3 rotation_rate_B = Vector3::Zero();
  if (body.modes > 0 && probe.Phi_B.cols() == body.modes) {
    const auto eta = state.eta.segment(body.offset, body.modes);
    const auto etadot = state.etadot.segment(body.offset, body.modes);
    motion.u_B = probe.Phi_B * eta;
    udot_B = probe.Phi_B * etadot;
    rotation_B = probe.Psi_B * eta;
    rotation_rate_B = probe.Psi_B * etadot;
    if (probe.second) {
      Matrix3X Phi = probe.Phi_B;
      Matrix3X Psi = probe.Psi_B;
      flexbody::add_slopes(*probe.second, eta.data(), Phi, Psi);
      motion.u_B = 0.5 * (motion.u_B + Phi * eta);
      rotation_B = 0.5 * (rotation_B + Psi * eta);
      udot_B = Phi * etadot;
      rotation_rate_B = Psi * etadot;
    }
  }
  const Matrix3 R_WB = rigid.quat_WB.toRotationMatrix();
  const Vector3 b = probe.p_B + motion.u_B;
  motion.p_W = rigid.p_WB + R_WB * b;
  motion.v_W = rigid.v_WB_W + R_WB * (rigid.w_WB_B.cross(b) + udot_B);
  motion.R_W = R_WB * exp_rotation(rotation_B);
  motion.w_W =
      R_WB * (rigid.w_WB_B + left_jacobian(rotation_B) * rotation_rate_B);
  return motion;
}

Motion find_nodal_motion(const PointProbe& probe,
                         const dynamics::SystemModel& model, std::size_t f,
                         const dynamics::SystemState& state) {
  const dynamics::FullModel& full = model.full_bodies[f];
  const Pose& X_WH = state.X_WH[f];
  dynamics::NodalFrameMotion frame;
  calc_nodal_frame(*probe.nodal, nodes_of(full, state.u_H),
                   nodes_of(full, state.udot_H), frame);
  Motion motion;
  motion.p_W = X_WH * frame.p_H;
  motion.v_W = X_WH.R * frame.v_H;
  motion.R_W = X_WH.R * frame.R_HB;
  motion.w_W = X_WH.R * frame.w_H;
  if (probe.quantity == Quantity::deformation) {
    dynamics::MeanFrame body;
    calc_mean_frame(model, full, state, body);
    motion.u_B = body.R_HB.transpose() * (frame.p_H - body.p_HB) - probe.p_B;
  }
  return motion;
}

Motion find_world_motion(const PointProbe& probe,
                         const dynamics::SystemModel& model,
                         const dynamics::SystemState& state) {
  if (probe.body == dynamics::kWorld) {
    Motion motion;
    motion.p_W = probe.p_B;
    motion.v_W.setZero();
    motion.R_W.setIdentity();
    motion.w_W.setZero();
    return motion;
  }
  const auto index = static_cast<std::size_t>(probe.body);
  const dynamics::BodyModel& body = model.bodies.at(index);
  if (probe.nodal) {
    return find_nodal_motion(probe, model, static_cast<std::size_t>(body.full),
                             state);
  }
  return find_modal_motion(probe, body, state.bodies.at(index), state);
}

Motion find_motion(const PointProbe& probe, const dynamics::SystemModel& model,
                   const dynamics::SystemState& state) {
  Motion motion = find_world_motion(probe, model, state);
  if (!probe.base) return motion;
  const Motion base = find_world_motion(*probe.base, model, state);
  const Matrix3 R_bW = (base.R_W * probe.base->R_BL).transpose();
  const Vector3 arm_W = motion.p_W - base.p_W;
  motion.p_W = R_bW * arm_W;
  motion.v_W = R_bW * (motion.v_W - base.v_W - base.w_W.cross(arm_W));
  motion.w_W = R_bW * (motion.w_W - base.w_W);
  motion.R_W = R_bW * motion.R_W;
  return motion;
}

}  // namespace

std::vector<ProbeColumnName> column_names(const PointProbe& probe,
                                          const std::string& name) {
  std::string letter;
  std::string unit;
  switch (probe.quantity) {
    case Quantity::displacement:
      letter = "u", unit = "m";
      break;
    case Quantity::position:
      letter = "", unit = "m";
      break;
    case Quantity::velocity:
      letter = "v", unit = "m/s";
      break;
    case Quantity::rotation:
      letter = "r", unit = "rad";
      break;
    case Quantity::angular_velocity:
      letter = "w", unit = "rad/s";
      break;
    case Quantity::deformation:
      letter = "d", unit = "m";
      break;
  }
  std::vector<ProbeColumnName> columns;
  for (const char* axis : {"x", "y", "z"}) {
    columns.push_back({name + "." + letter + axis, unit});
  }
  return columns;
}

Vector3 evaluate(const PointProbe& probe, const dynamics::SystemModel& model,
                 const dynamics::SystemState& state) {
  const Motion motion = find_motion(probe, model, state);
  switch (probe.quantity) {
    case Quantity::displacement:
      return motion.p_W - probe.p_start_W;
    case Quantity::position:
      return motion.p_W;
    case Quantity::velocity:
      return motion.v_W;
    case Quantity::rotation:
      return log_rotation(Matrix3(motion.R_W * probe.R_start.transpose()));
    case Quantity::angular_velocity:
      return motion.w_W;
    case Quantity::deformation:
      return probe.R_BL.transpose() * motion.u_B;
  }
  return Vector3::Zero();
}

void set_start(PointProbe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state) {
  const Motion motion = find_motion(probe, model, state);
  probe.p_start_W = motion.p_W;
  probe.R_start = motion.R_W;
}

}  // namespace limber::scene
