// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/terms/attachment_jacobian.hpp"

#include "limber/common/rotation.hpp"

namespace limber::dynamics {

void calc_modal_jacobian(const Attachment& attachment,
                         const AttachmentMotion& motion, const Matrix3& R_AW,
                         Matrix6X& G) {
  const Matrix3 R_AB = R_AW * motion.R_WB;
  const Matrix3 R_AB_twist = R_AB * motion.J_psi;
  G.leftCols<3>().topRows<3>() = R_AW;
  G.leftCols<3>().bottomRows<3>().setZero();
  G.middleCols<3>(3).topRows<3>() = -R_AB * skew(motion.arm_B);
  G.middleCols<3>(3).bottomRows<3>() = R_AB;
  const Matrix3X& Phi_B = translation_of(attachment, motion);
  const Matrix3X& Psi_B = rotation_of(attachment, motion);
  for (Eigen::Index k = 0; k < Phi_B.cols(); ++k) {
    G.col(6 + k).head<3>() = R_AB * Phi_B.col(k);
    G.col(6 + k).tail<3>() = R_AB_twist * Psi_B.col(k);
  }
}

void calc_nodal_jacobian(const NodalFrame& frame,
                         const NodalFrameMotion& motion, const Matrix3& R_AH,
                         Matrix6X& G) {
  G.setZero();
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    G.block<3, 3>(0, 3 * frame.nodes[i]) =
        frame.weights[static_cast<Eigen::Index>(i)] * R_AH;
  }
  const Matrix3 R_arm = R_AH * skew(motion.arm_H);
  for (std::size_t i = 0; i < frame.turning.size(); ++i) {
    const Vector3 y_H =
        motion.R_HB * frame.y_B.col(static_cast<Eigen::Index>(i));
    const Matrix3 rotation = motion.spread * skew(y_H);
    G.block<3, 3>(0, 3 * frame.turning[i]) -= R_arm * rotation;
    G.block<3, 3>(3, 3 * frame.turning[i]) = R_AH * rotation;
  }
  if (!frame.is_line()) return;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const Matrix3 rotation =
        frame.lever[static_cast<Eigen::Index>(i)] * motion.line_spread;
    G.block<3, 3>(0, 3 * frame.nodes[i]) -= R_arm * rotation;
    G.block<3, 3>(3, 3 * frame.nodes[i]) += R_AH * rotation;
  }
}

}  // namespace limber::dynamics
