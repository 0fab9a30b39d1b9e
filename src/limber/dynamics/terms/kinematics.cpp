// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/terms/kinematics.hpp"

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"

namespace limber::dynamics {
namespace {

// The tables at eta, and the rotation vector. @returns the translation
Vector3 calc_second_order(const Attachment& attachment, const double* eta,
                          AttachmentMotion& motion) {
  motion.Phi_B = attachment.Phi_B;
  motion.Psi_B = attachment.Psi_B;
  flexbody::add_slopes(*attachment.second, eta, motion.Phi_B, motion.Psi_B);
  motion.wrench_B.setZero();
  motion.psi =
      0.5 * (combine(attachment.Psi_B, eta) + combine(motion.Psi_B, eta));
  return 0.5 * (combine(attachment.Phi_B, eta) + combine(motion.Phi_B, eta));
}

}  // namespace

void rest_in_world(const Attachment& attachment, AttachmentMotion& motion) {
  motion.R_WB.setIdentity();
  motion.R_WF = attachment.R_BF;
  motion.arm_B = attachment.p_BF;
  motion.J_psi.setIdentity();
  motion.p_WF = attachment.p_BF;
  motion.v_WF_W.setZero();
  motion.w_WF_W.setZero();
}

void calc_attachment_motion(const BodyModel& body, const Attachment& attachment,
                            const SystemState& state, const Matrix3& R_WB,
                            AttachmentMotion& motion) {
  const BodyState& rigid = state.bodies[index(attachment.body)];
  motion.R_WB = R_WB;
  motion.arm_B = attachment.p_BF;
  Vector3 w_B = rigid.w_WB_B;
  Vector3 udot_B = Vector3::Zero();
  if (body.modes > 0) {
    const double* eta = state.eta.data() + body.offset;
    const double* etadot = state.etadot.data() + body.offset;
    Vector3 psidot = Vector3::Zero();
    if (attachment.second) {
      motion.arm_B += calc_second_order(attachment, eta, motion);
      udot_B = combine(motion.Phi_B, etadot);
      psidot = combine(motion.Psi_B, etadot);
    } else {
      const kernels::InterfaceMotion moved = kernels::calc_interface_motion(
          columns_of(attachment.Phi_B, attachment.Psi_B), eta, etadot);
      motion.arm_B += Eigen::Map<const Vector3>(moved.u.data());
      motion.psi = Eigen::Map<const Vector3>(moved.psi.data());
      udot_B = Eigen::Map<const Vector3>(moved.udot.data());
      psidot = Eigen::Map<const Vector3>(moved.psidot.data());
    }
    motion.J_psi = left_jacobian(motion.psi);
    w_B += motion.J_psi * psidot;
    motion.R_WF = R_WB * (exp_rotation(motion.psi) * attachment.R_BF);
  } else {
    motion.J_psi.setIdentity();
    motion.R_WF = R_WB * attachment.R_BF;
  }
  motion.p_WF = rigid.p_WB + R_WB * motion.arm_B;
  motion.v_WF_W =
      rigid.v_WB_W + R_WB * (rigid.w_WB_B.cross(motion.arm_B) + udot_B);
  motion.w_WF_W = R_WB * w_B;
}

void calc_nodal_attachment(const FullModel& full, const Pose& X_WH,
                           const Attachment& attachment,
                           const SystemState& state, NodalFrameMotion& nodal,
                           AttachmentMotion& motion) {
  calc_nodal_frame(*attachment.nodal, nodes_of(full, state.u_H),
                   nodes_of(full, state.udot_H), nodal);
  motion.R_WB = X_WH.R * nodal.R_HB;
  motion.R_WF = X_WH.R * nodal.R_HB * attachment.R_BF;
  motion.arm_B.setZero();
  motion.J_psi.setIdentity();
  motion.p_WF = X_WH * nodal.p_H;
  motion.v_WF_W = X_WH.R * nodal.v_H;
  motion.w_WF_W = X_WH.R * nodal.w_H;
}

joints::RelativeMotion relate(const FrameMotion& F, const FrameMotion& M) {
  const Matrix3 R_FW = F.X_WF.R.transpose();
  const Vector3 w_F = R_FW * F.w_WF_W;
  joints::RelativeMotion relative;
  relative.R_FM = R_FW * M.X_WF.R;
  relative.p_FM_F = R_FW * (M.X_WF.p - F.X_WF.p);
  relative.v_FM_F = R_FW * (M.v_WF_W - F.v_WF_W) - w_F.cross(relative.p_FM_F);
  relative.w_FM_F = R_FW * M.w_WF_W - w_F;
  return relative;
}

FrameMotion follow(const FrameMotion& F,
                   const joints::RelativeMotion& relative) {
  FrameMotion M;
  M.X_WF = F.X_WF * Pose{relative.R_FM, relative.p_FM_F};
  M.v_WF_W = F.v_WF_W + F.w_WF_W.cross(M.X_WF.p - F.X_WF.p) +
             F.X_WF.R * relative.v_FM_F;
  M.w_WF_W = F.w_WF_W + F.X_WF.R * relative.w_FM_F;
  return M;
}

joints::RelativeMotion invert(const joints::RelativeMotion& relative) {
  const Matrix3 R_MF = relative.R_FM.transpose();
  joints::RelativeMotion inverse;
  inverse.R_FM = R_MF;
  inverse.p_FM_F = -(R_MF * relative.p_FM_F);
  inverse.v_FM_F =
      R_MF * (relative.w_FM_F.cross(relative.p_FM_F) - relative.v_FM_F);
  inverse.w_FM_F = -(R_MF * relative.w_FM_F);
  return inverse;
}

SystemState make_state(const SystemModel& model) {
  SystemState state;
  state.bodies.resize(model.bodies.size());
  state.eta = VectorX::Zero(model.modal_count);
  state.etadot = VectorX::Zero(model.modal_count);
  state.maxwell = VectorX::Zero(model.maxwell_count);
  state.X_WH.resize(model.full_bodies.size());
  state.u_H = VectorX::Zero(model.nodal_count);
  state.udot_H = VectorX::Zero(model.nodal_count);
  state.memory.resize(model.couplers.size() + model.transmissions.size());
  for (const Input& input : model.inputs) {
    state.inputs.push_back(
        {.value = input.initial, .value_before = input.initial});
  }
  for (const ControllerModel& controller : model.controllers) {
    state.controllers.push_back({0, controller.memory});
  }
  state.pair_memory = PairMemory(model.pair_memory_size);
  state.far_pairs.assign(model.pairs.size(), 0);
  return state;
}

}  // namespace limber::dynamics
