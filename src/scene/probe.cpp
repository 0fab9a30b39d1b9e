// SPDX-License-Identifier: BSD-3-Clause
#include "scene/probe.hpp"

#include "common/rotation.hpp"

namespace limber::scene {
namespace {

/// What a probe sees of its body.
struct Motion {
  dynamics::BodyState body;
  Matrix3 R_WB;
  Vector3 u_B = Vector3::Zero();        ///< Phi_B eta [m]
  Vector3 udot_B = Vector3::Zero();     ///< [m/s]
  Vector3 turn_B = Vector3::Zero();     ///< Psi_B eta [rad]
  Vector3 turndot_B = Vector3::Zero();  ///< [rad/s]
};

Motion find_motion(const Probe& probe, const dynamics::SystemModel& model,
                   const dynamics::SystemState& state) {
  const auto index = static_cast<std::size_t>(probe.body);
  const dynamics::BodyModel& body = model.bodies.at(index);
  Motion motion;
  motion.body = state.bodies.at(index);
  motion.R_WB = motion.body.quat_WB.toRotationMatrix();
  if (body.modes == 0 || probe.Phi_B.cols() != body.modes) return motion;
  const VectorX eta = state.eta.segment(body.offset, body.modes);
  const VectorX etadot = state.etadot.segment(body.offset, body.modes);
  motion.u_B = probe.Phi_B * eta;
  motion.udot_B = probe.Phi_B * etadot;
  motion.turn_B = probe.Psi_B * eta;
  motion.turndot_B = probe.Psi_B * etadot;
  return motion;
}

Vector3 position(const Probe& probe, const Motion& motion) {
  return motion.body.p_WB + motion.R_WB * (probe.p_B + motion.u_B);
}

Vector3 velocity(const Probe& probe, const Motion& motion) {
  return motion.body.v_WB_W +
         motion.R_WB *
             (motion.body.w_WB_B.cross(probe.p_B + motion.u_B) + motion.udot_B);
}

Matrix3 orientation(const Motion& motion) {
  return motion.R_WB * exp_rotation(motion.turn_B);
}

}  // namespace

std::vector<ProbeColumnName> column_names(const Probe& probe) {
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
    columns.push_back({probe.name + "." + letter + axis, unit});
  }
  return columns;
}

Vector3 evaluate(const Probe& probe, const dynamics::SystemModel& model,
                 const dynamics::SystemState& state) {
  const Motion motion = find_motion(probe, model, state);
  switch (probe.quantity) {
    case Quantity::displacement:
      return position(probe, motion) - probe.p_start_W;
    case Quantity::position:
      return position(probe, motion);
    case Quantity::velocity:
      return velocity(probe, motion);
    case Quantity::rotation:
      return log_rotation(
          Matrix3(orientation(motion) * probe.R_start.transpose()));
    case Quantity::angular_velocity:
      return motion.R_WB * (motion.body.w_WB_B +
                            left_jacobian(motion.turn_B) * motion.turndot_B);
    case Quantity::deformation:
      return probe.R_BL.transpose() * motion.u_B;
  }
  return Vector3::Zero();
}

void set_start(Probe& probe, const dynamics::SystemModel& model,
               const dynamics::SystemState& state) {
  const Motion motion = find_motion(probe, model, state);
  probe.p_start_W = position(probe, motion);
  probe.R_start = orientation(motion);
}

std::vector<double> evaluate_all(const std::vector<Probe>& probes,
                                 const dynamics::SystemModel& model,
                                 const dynamics::SystemState& state) {
  std::vector<double> values;
  values.reserve(3 * probes.size());
  for (const Probe& probe : probes) {
    const Vector3 value = evaluate(probe, model, state);
    values.insert(values.end(), value.data(), value.data() + 3);
  }
  return values;
}

}  // namespace limber::scene
