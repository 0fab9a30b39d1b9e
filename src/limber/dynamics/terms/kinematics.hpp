// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/kernels/column_kernels.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

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

/// An attachment's motion, with the data to map forces back to the body.
///
/// Equation   p_WF = p_WB + R_WB (p_BF + Phi eta),
///            R_WF = R_WB exp(Psi eta) R_BF,
///            w_WF = R_WB (w_WB_B + J_l(Psi eta) Psi etadot);
///            at level nonlinear to second order in eta
///            (flexbody/model/quadratic_frame.hpp).
struct AttachmentMotion {
  Matrix3 R_WB;    ///< [-]
  Matrix3 R_WF;    ///< [-]
  Vector3 arm_B;   ///< p_BF + Phi eta, from Bo [m]
  Matrix3 J_psi;   ///< left Jacobian at Psi eta [-]
  Vector3 p_WF;    ///< [m]
  Vector3 v_WF_W;  ///< [m/s]
  Vector3 w_WF_W;  ///< [rad/s]
  Vector3 psi;     ///< rotation vector in the body, Psi eta [rad]
  int nodal =
      -1;  ///< index into SystemTerms::nodal_frames, on an unreduced body
  /// Of an interface at level nonlinear alone: its tables at eta, 3 x m, and
  /// the force and moment J_psi' m on it, body frame [N, N m].
  Matrix3X Phi_B;  ///< [kg^-1/2]
  Matrix3X Psi_B;  ///< [kg^-1/2 m^-1]
  Vector6 wrench_B;
};

/// Tangent of the frame by the modes: du = Phi d_eta, dpsi = Psi d_eta.
[[nodiscard]] inline const Matrix3X& translation_of(
    const Attachment& attachment, const AttachmentMotion& motion) {
  return attachment.second ? motion.Phi_B : attachment.Phi_B;
}
[[nodiscard]] inline const Matrix3X& rotation_of(
    const Attachment& attachment, const AttachmentMotion& motion) {
  return attachment.second ? motion.Psi_B : attachment.Psi_B;
}

/// Two 3 x m tables for the kernels.
[[nodiscard]] inline kernels::InterfaceColumns columns_of(
    const Matrix3X& Phi_B, const Matrix3X& Psi_B) {
  return {Phi_B.data(), Psi_B.data(), static_cast<std::size_t>(Phi_B.cols())};
}

/// Of an attachment on the world.
void rest_in_world(const Attachment& attachment, AttachmentMotion& motion);

/// Of an attachment on a modal body. @param R_WB the body's rotation matrix
void calc_attachment_motion(const BodyModel& body, const Attachment& attachment,
                            const SystemState& state, const Matrix3& R_WB,
                            AttachmentMotion& motion);

/// Of an attachment on an unreduced body with home frame X_WH. Fills `nodal`,
/// too.
void calc_nodal_attachment(const FullModel& full, const Pose& X_WH,
                           const Attachment& attachment,
                           const SystemState& state, NodalFrameMotion& nodal,
                           AttachmentMotion& motion);

[[nodiscard]] inline FrameMotion frame_motion(const AttachmentMotion& motion) {
  return {{motion.R_WF, motion.p_WF}, motion.v_WF_W, motion.w_WF_W};
}

/// Motion of frame M in frame F, from their motions in the world.
[[nodiscard]] joints::RelativeMotion relate(const FrameMotion& F,
                                            const FrameMotion& M);

/// The reverse: motion of M in the world, from that of F and of M in F.
[[nodiscard]] FrameMotion follow(const FrameMotion& F,
                                 const joints::RelativeMotion& relative);

/// Motion of frame F in frame M, from that of M in F.
[[nodiscard]] joints::RelativeMotion invert(
    const joints::RelativeMotion& relative);

}  // namespace limber::dynamics
