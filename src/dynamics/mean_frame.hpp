// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// The mean-axis frame B of an unreduced body, in its home frame H: the frame
/// that a reduced body moves with.
///
/// Equation   sum_ij M_ij x_i x R^T (p_j - p) = 0, and its rate
/// Source     Tisserand frame, docs/theory/equations.md
struct MeanFrame {
  Matrix3 R_HB = Matrix3::Identity();
  Vector3 p_HB = Vector3::Zero();  ///< [m]
  Vector3 v_H = Vector3::Zero();   ///< [m/s]
  Vector3 w_H = Vector3::Zero();   ///< [rad/s]
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

/// Deformation in the body frame, 3 x N [m]: R_HB^T (x + u - p_HB) - x.
void calc_deformation(const FullModel& full, const MeanFrame& frame,
                      const ConstNodes& u_H, Eigen::Ref<Matrix3X> u_B);

}  // namespace limber::dynamics
