// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// The mean-axis frame B of an unreduced body, in its home frame H: the same
/// frame as that of a reduced body.
///
/// Equation   sum_ij M_ij x_i x R^T (p_j - p) = 0, and its rate
/// Source     Tisserand frame, docs/theory/equations.md
struct MeanFrame {
  Matrix3 R_HB = Matrix3::Identity();  ///< [-]
  Vector3 p_HB = Vector3::Zero();      ///< [m]
  Vector3 v_H = Vector3::Zero();       ///< [m/s]
  Vector3 w_H = Vector3::Zero();       ///< [rad/s]
  Vector3 center_H = Vector3::Zero();  ///< mean of the nodes' masses [m]
  /// w_H = spread sum_i R y_i x u'_i, y_i the first moments; zero if the frame
  /// does not rotate [1/(kg m^2)].
  Matrix3 spread = Matrix3::Zero();
};

/// The nodes of one unreduced body in a vector like SystemState::u_H.
[[nodiscard]] inline ConstNodes nodes_of(const FullModel& full,
                                         const VectorX& all) {
  return {all.data() + full.first, 3, full.mesh->node_count()};
}
[[nodiscard]] inline Nodes nodes_of(const FullModel& full, VectorX& all) {
  return {all.data() + full.first, 3, full.mesh->node_count()};
}

/// Identity, at rest, if the body is clamped.
void calc_mean_frame(const SystemModel& model, const FullModel& full,
                     const SystemState& state, MeanFrame& frame);

/// Distributes a force [N] at center_H and a moment [N m] to the nodes so that
/// their power is that of both in the frame's motion.
///
/// Equation   f_i = m_i / m force + (spread moment) x R y_i
/// @param nodal 3 x N, H
void add_mean_wrench(const flexbody::FullBody& mesh, const MeanFrame& frame,
                     const Vector3& force_H, const Vector3& moment_H,
                     Eigen::Ref<Matrix3X> nodal);

/// Deformation in the body frame, 3 x N [m]: R_HB^T (x + u - p_HB) - x.
void calc_deformation(const FullModel& full, const MeanFrame& frame,
                      const ConstNodes& u_H, Eigen::Ref<Matrix3X> u_B);

}  // namespace limber::dynamics
