// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/mean_frame.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Sum_k columns(k) x(k): a 3 x m table times modal coordinates, without the
/// overhead of a general product.
[[nodiscard]] inline Vector3 combine(const Matrix3X& columns, const double* x) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    sum += columns.col(k) * x[k];
  }
  return sum;
}

/// An attachment's motion with what forces need to come back through it.
///
/// Equation   p_WF = p_WB + R_WB (p_BF + Phi eta),
///            R_WF = R_WB exp(Psi eta) R_BF,
///            w_WF = R_WB (w_WB_B + J_l(Psi eta) Psi etadot).
struct AttachmentMotion {
  Matrix3 R_WB;
  Matrix3 R_WF;
  Vector3 arm_B;  ///< p_BF + Phi eta, from Bo [m]
  Matrix3 J_psi;  ///< left Jacobian at Psi eta
  Vector3 p_WF;
  Vector3 v_WF_W;
  Vector3 w_WF_W;
  NodalFrameMotion nodal;  ///< on an unreduced body
};

/// Fills `motion`; `R_WB` is the body's rotation matrix (not read for world).
void calc_attachment_motion(const SystemModel& model,
                            const Attachment& attachment,
                            const SystemState& state, const Matrix3& R_WB,
                            AttachmentMotion& motion);

/// The same of an attachment on an unreduced body.
void calc_nodal_attachment(const SystemModel& model,
                           const Attachment& attachment,
                           const SystemState& state, AttachmentMotion& motion);

/// Motion of frame M in frame F, from that of both in the world.
[[nodiscard]] joints::RelativeMotion relate(const FrameMotion& F,
                                            const FrameMotion& M);

}  // namespace limber::dynamics
