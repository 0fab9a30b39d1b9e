// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/newton/residual_derivative.hpp"

#include <utility>

#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/body.hpp"
#include "limber/dynamics/bodies/body_increment.hpp"
#include "limber/dynamics/newton/link_rows.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/dynamics/terms/attachment_jacobian.hpp"

namespace limber::dynamics {
namespace {

// Change of half_square along dw.
Vector6 change_half_square(const Vector3& w, const Vector3& dw) {
  Vector6 q;
  q << w[0] * dw[0], w[1] * dw[1], w[2] * dw[2], w[0] * dw[1] + w[1] * dw[0],
      w[0] * dw[2] + w[2] * dw[0], w[1] * dw[2] + w[2] * dw[1];
  return q;
}

// Change of a wrench by rotation of its axes.
Vector6 rotate(const Vector3& phi, const Vector6& wrench) {
  Vector6 turned;
  turned << phi.cross(wrench.head<3>()), phi.cross(wrench.tail<3>());
  return turned;
}

// Change of an interface's tables at level nonlinear by the modes.
std::pair<Matrix3X, Matrix3X> change_tables(const Attachment& attachment,
                                            const double* d_eta) {
  const Eigen::Index m = attachment.Phi_B.cols();
  std::pair<Matrix3X, Matrix3X> change{Matrix3X::Zero(3, m),
                                       Matrix3X::Zero(3, m)};
  flexbody::add_slopes(*attachment.second, d_eta, change.first, change.second);
  return change;
}

}  // namespace

ResidualDerivative::ResidualDerivative(const SystemModel& model)
    : model_(model),
      is_moved_(model.bodies.size()),
      frames_(model.attachments.size()),
      motions_(model.couplers.size()) {}

void ResidualDerivative::set_point(
    const SystemState& state, const SystemTerms& terms,
    const VectorX& acceleration, const VectorX& motion,
    const NewtonMatrix::Coefficients& coefficients) {
  state_ = &state;
  terms_ = &terms;
  acceleration_ = &acceleration;
  motion_ = &motion;
  c_ = coefficients;
}

// All except the terms of NewtonMatrix: M, gyroscopic terms of J, dampers and
// elasticity of modes, geometric stiffness of interfaces.
void ResidualDerivative::change_inertia(std::size_t b, const VectorX& x,
                                        VectorX& r) const {
  const BodyModel& body = model_.bodies[b];
  if (body.modes == 0 || !body.has_rigid_motion()) return;
  const BodyTerms& t = terms_->bodies[b];
  const BodyIncrement d(body, x);
  const Vector3& w = state_->bodies[b].w_WB_B;
  const Vector3 wdot = rotation_rows(body, *acceleration_);
  const Vector3 d_w =
      c_.velocity *
      (right_jacobian_inverse(rotation_rows(body, *motion_)) * d.theta);
  const Vector6 d_w_squared = change_half_square(w, d_w);
  auto r_modes = r.segment(body.row + 6, body.modes);
  if (is_one_way(body)) {
    r_modes -= body.inertia->J1() * d_w_squared;
  }
  if (!is_coupled(body.fidelity)) return;

  const Eigen::Map<const VectorX> d_eta(d.eta, body.modes);
  const double* etadot = state_->etadot.data() + body.offset;
  const double* etaddot = acceleration_->data() + body.row + 6;
  const ModalInertia& inertia = *body.inertia;
  const VectorX products = inertia.columns.rightCols(body.modes) * d_eta;
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 9>> changes(
      products.data(), products.size() / 9, 9);
  const Vector6 w_squared = half_square(w);
  Vector6 Jdot = Vector6::Zero();
  Vector6 d_J = Vector6::Zero();
  Vector6 d_Jdot = Vector6::Zero();
  Vector3 h = Vector3::Zero();  // H etadot
  Vector3 d_h = Vector3::Zero();
  Vector3 d_H_etaddot = Vector3::Zero();
  for (int k = 0; k < body.modes; ++k) {
    const Vector6 J_k = t.dJ(k);
    const Vector6 d_J_k = changes.row(k).head<6>();
    const Vector3 d_H = changes.row(k).tail<3>();
    const double d_etadot = c_.velocity * d_eta[k];
    Jdot += J_k * etadot[k];
    d_J += J_k * d_eta[k];
    d_Jdot += d_J_k * etadot[k] + J_k * d_etadot;
    h += t.H().col(k) * etadot[k];
    d_h += d_H * etadot[k] + t.H().col(k) * d_etadot;
    d_H_etaddot += d_H * etaddot[k];
    r_modes[k] += d_H.dot(wdot) + 2.0 * d_w.dot(t.beta_rate(k)) +
                  2.0 * c_.velocity * w.dot(d_H) - d_w_squared.dot(J_k) -
                  w_squared.dot(d_J_k);
  }
  const Matrix3 d_inertia = unpack_symmetric(d_J);
  r.segment<3>(body.row + 3) += d_inertia * wdot + d_H_etaddot +
                                unpack_symmetric(d_Jdot) * w +
                                unpack_symmetric(Jdot) * d_w + d_w.cross(h) +
                                w.cross(d_inertia * w + d_h);
}

ResidualDerivative::FrameChange ResidualDerivative::change_frame(
    const Attachment& attachment, const AttachmentMotion& motion,
    const VectorX& x) const {
  FrameChange change;
  if (attachment.body == kWorld) return change;
  const auto b = index(attachment.body);
  const BodyModel& body = model_.bodies[b];
  const BodyIncrement d(body, x);
  const Matrix3& R = motion.R_WB;
  const Vector3& w = state_->bodies[b].w_WB_B;
  const Vector3 d_w =
      c_.velocity *
      (right_jacobian_inverse(rotation_rows(body, *motion_)) * d.theta);
  Vector3 u = Vector3::Zero();  // change of the arm
  Vector3 udot = Vector3::Zero();
  Vector3 d_udot = Vector3::Zero();  // by the tables' change
  Vector3 turned = Vector3::Zero();  // J_psi Psi d_eta
  Vector3 w_frame = w;
  Vector3 d_w_frame = d_w;
  if (body.modes > 0) {
    const double* etadot = state_->etadot.data() + body.offset;
    const Matrix3X& Phi_B = translation_of(attachment, motion);
    const Matrix3X& Psi_B = rotation_of(attachment, motion);
    const Vector3 psidot = combine(Psi_B, etadot);
    const Vector3 d_psi = combine(Psi_B, d.eta);
    u = combine(Phi_B, d.eta);
    udot = combine(Phi_B, etadot);
    turned = motion.J_psi * d_psi;
    w_frame += motion.J_psi * psidot;
    d_w_frame += left_jacobian_derivative(motion.psi, d_psi) * psidot +
                 c_.velocity * turned;
    if (attachment.second) {
      const auto [d_Phi, d_Psi] = change_tables(attachment, d.eta);
      d_udot = combine(d_Phi, etadot);
      d_w_frame += motion.J_psi * combine(d_Psi, etadot);
    }
  }
  const Vector3 v = w.cross(motion.arm_B) + udot;
  change.p = d.p + R * (d.theta.cross(motion.arm_B) + u);
  change.phi = R * (d.theta + turned);
  change.v =
      c_.velocity * d.p + R * (d.theta.cross(v) + d_w.cross(motion.arm_B) +
                               w.cross(u) + c_.velocity * u + d_udot);
  change.w = R * (d.theta.cross(w_frame) + d_w_frame);
  return change;
}

ResidualDerivative::FrameChange ResidualDerivative::change_nodal_frame(
    const Attachment& attachment, const AttachmentMotion& motion,
    const VectorX& x) const {
  const NodalFrameMotion& nodal = terms_->nodal_frame(motion);
  // Of a nodal frame only nodes move.
  const UnknownRange nodes =
      *list_unknowns(model_, index(attachment.body)).begin();
  Matrix6X G(6, nodes.size);
  calc_nodal_jacobian(*attachment.nodal, nodal,
                      motion.R_WB * nodal.R_HB.transpose(), G);
  const Vector6 moved = G * x.segment(nodes.row, nodes.size);
  return {moved.head<3>(), moved.tail<3>(), c_.velocity * moved.head<3>(),
          c_.velocity * moved.tail<3>()};
}

void ResidualDerivative::find_moved(const VectorX& x) {
  for (std::size_t b = 0; b < is_moved_.size(); ++b) {
    is_moved_[b] = 0;
    for (const UnknownRange& range : list_unknowns(model_, b)) {
      if (!x.segment(range.row, range.size).isZero(0.0)) is_moved_[b] = 1;
    }
  }
}

bool ResidualDerivative::is_moved(AttachmentIndex attachment) const {
  const BodyIndex body = model_.attachments[index(attachment)].body;
  return body != kWorld && is_moved_[index(body)] != 0;
}

void ResidualDerivative::change_frames(const VectorX& x) {
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Attachment& attachment = model_.attachments[i];
    const AttachmentMotion& motion = terms_->attachments[i];
    if (!is_moved(static_cast<AttachmentIndex>(i))) {
      frames_[i] = {};
      continue;
    }
    frames_[i] = attachment.nodal ? change_nodal_frame(attachment, motion, x)
                                  : change_frame(attachment, motion, x);
  }
}

// Derivative of relate in dynamics/kinematics, all in F.
ResidualDerivative::MotionChange ResidualDerivative::relate(
    const Coupler& coupler, const CouplerTerms& terms) const {
  const AttachmentMotion& F = terms_->attachments[index(coupler.frame_F)];
  const AttachmentMotion& M = terms_->attachments[index(coupler.frame_M)];
  const FrameChange& dF = frames_[index(coupler.frame_F)];
  const FrameChange& dM = frames_[index(coupler.frame_M)];
  const Matrix3 R_FW = F.R_WF.transpose();
  const Vector3 phi = R_FW * dF.phi;
  const Vector3& p = terms.motion.p_FM_F;
  const Vector3 w_F = R_FW * F.w_WF_W;
  const Vector3 d_w_F = R_FW * dF.w - phi.cross(w_F);
  const Vector3 d_p = R_FW * (dM.p - dF.p) - phi.cross(p);
  MotionChange change;
  change.position << d_p, R_FW * (dM.phi - dF.phi);
  change.velocity.head<3>() = R_FW * (dM.v - dF.v) -
                              phi.cross(R_FW * (M.v_WF_W - F.v_WF_W)) -
                              d_w_F.cross(p) - w_F.cross(d_p);
  change.velocity.tail<3>() = R_FW * dM.w - phi.cross(R_FW * M.w_WF_W) - d_w_F;
  return change;
}

void ResidualDerivative::change_wrench(AttachmentIndex attachment,
                                       const Vector3& force,
                                       const Vector3& moment,
                                       const Vector3& d_force,
                                       const Vector3& d_moment,
                                       const VectorX& x, VectorX& r) const {
  const Attachment& a = model_.attachments[index(attachment)];
  if (a.body == kWorld || a.nodal) return;
  const auto b = index(a.body);
  const BodyModel& body = model_.bodies[b];
  const AttachmentMotion& motion = terms_->attachments[index(attachment)];
  const BodyIncrement d(body, x);
  const Matrix3 R_BW = motion.R_WB.transpose();
  const Vector3 force_B = R_BW * force;
  const Vector3 moment_B = R_BW * moment;
  const Vector3 d_force_B = R_BW * d_force - d.theta.cross(force_B);
  const Vector3 d_moment_B = R_BW * d_moment - d.theta.cross(moment_B);
  Vector3 d_arm = Vector3::Zero();
  if (body.modes > 0) {
    const Matrix3X& Phi_B = translation_of(a, motion);
    const Matrix3X& Psi_B = rotation_of(a, motion);
    d_arm = combine(Phi_B, d.eta);
    const Vector3 d_psi = combine(Psi_B, d.eta);
    const Vector3 d_twist =
        left_jacobian_derivative(motion.psi, d_psi).transpose() * moment_B +
        motion.J_psi.transpose() * d_moment_B;
    r.segment(body.row + 6, body.modes) -=
        Phi_B.transpose() * d_force_B + Psi_B.transpose() * d_twist;
  }
  if (!body.has_rigid_motion()) return;
  r.segment<3>(body.row) -= d_force;
  r.segment<3>(body.row + 3) -=
      d_arm.cross(force_B) + motion.arm_B.cross(d_force_B) + d_moment_B;
}

// Derivative of add_pair in coupler_forces, with a change d_wrench of the
// wrench in F.
void ResidualDerivative::change_pair(const Coupler& coupler,
                                     const CouplerTerms& terms,
                                     const MotionChange& change,
                                     const Vector6& wrench,
                                     const Vector6& d_wrench, const VectorX& x,
                                     VectorX& r) const {
  const Matrix3& R_WF = terms_->attachments[index(coupler.frame_F)].R_WF;
  const Vector3& p = terms.motion.p_FM_F;
  const Vector3 force_F = wrench.head<3>();
  const Vector3 d_force_F = d_wrench.head<3>();
  Vector6 on_F;  // about Fo
  on_F << force_F, wrench.tail<3>() + p.cross(force_F);
  Vector6 d_on_F;
  d_on_F << d_force_F, d_wrench.tail<3>() + p.cross(d_force_F) +
                           Vector3(change.position.head<3>()).cross(force_F);
  const Vector3 phi = R_WF.transpose() * frames_[index(coupler.frame_F)].phi;
  const Vector6 d_M = d_wrench + rotate(phi, wrench);
  const Vector6 d_F = d_on_F + rotate(phi, on_F);
  change_wrench(coupler.frame_M, R_WF * force_F, R_WF * wrench.tail<3>(),
                R_WF * d_M.head<3>(), R_WF * d_M.tail<3>(), x, r);
  change_wrench(coupler.frame_F, -(R_WF * force_F), -(R_WF * on_F.tail<3>()),
                -(R_WF * d_F.head<3>()), -(R_WF * d_F.tail<3>()), x, r);
}

void ResidualDerivative::change_couplers(const VectorX& x, VectorX& r,
                                         std::vector<Vector6>& laws) {
  for (std::size_t c = 0; c < model_.couplers.size(); ++c) {
    const Coupler& coupler = model_.couplers[c];
    const CouplerTerms& terms = terms_->couplers[c];
    if (!is_moved(coupler.frame_F) && !is_moved(coupler.frame_M)) {
      motions_[c] = {};
      laws[c].setZero();
      continue;
    }
    motions_[c] = relate(coupler, terms);
    change_pair(coupler, terms, motions_[c], terms.applied, Vector6::Zero(), x,
                r);
    laws[c] = -terms.response.damping *
              (motions_[c].velocity - c_.velocity * motions_[c].position);
    if (const auto* constraint = find_constraint(*terms_, c)) {
      laws[c] = remove_constrained(*constraint, laws[c]);
    }
  }
  for (std::size_t i = 0; i < model_.transmissions.size(); ++i) {
    const TransmissionTerms& terms = terms_->transmissions[i];
    Vector6& law = laws[model_.couplers.size() + i];
    law.setZero();
    const auto& coordinate = model_.transmissions[i].coordinate;
    if (const auto* path = std::get_if<PathCoordinate>(&coordinate)) {
      change_path(*path, terms, x, r, law);
    } else {
      change_sum(std::get<JointSum>(coordinate), terms, x, r, law);
    }
  }
}

void ResidualDerivative::change_path(const PathCoordinate& path,
                                     const TransmissionTerms& terms,
                                     const VectorX& x, VectorX& r,
                                     Vector6& law) const {
  double d_z = 0.0;
  double d_rate = 0.0;
  Vector3 d_before = Vector3::Zero();  // of the direction of the last segment
  const std::size_t count = path.points.size();
  for (std::size_t i = 0; i < count; ++i) {
    Vector3 d_after = Vector3::Zero();
    if (i + 1 < count) {
      const auto from = index(path.points[i]);
      const auto to = index(path.points[i + 1]);
      const AttachmentMotion& a = terms_->attachments[from];
      const AttachmentMotion& b = terms_->attachments[to];
      const double length = (b.p_WF - a.p_WF).norm();
      const Vector3 direction = (b.p_WF - a.p_WF) / length;
      const Vector3 d_p = frames_[to].p - frames_[from].p;
      d_after = (d_p - direction * direction.dot(d_p)) / length;
      d_z += direction.dot(d_p);
      d_rate += d_after.dot(b.v_WF_W - a.v_WF_W) +
                direction.dot(frames_[to].v - frames_[from].v);
    }
    change_wrench(path.points[i], terms.applied * terms.gradients[i].head<3>(),
                  Vector3::Zero(), terms.applied * (d_before - d_after),
                  Vector3::Zero(), x, r);
    d_before = d_after;
  }
  law[0] = -terms.response.damping * (d_rate - c_.velocity * d_z);
}

void ResidualDerivative::change_sum(const JointSum& sum,
                                    const TransmissionTerms& terms,
                                    const VectorX& x, VectorX& r,
                                    Vector6& law) const {
  double d_z = 0.0;
  double d_rate = 0.0;
  for (std::size_t i = 0; i < sum.terms.size(); ++i) {
    const JointSum::Term& term = sum.terms[i];
    const auto c = index(term.coupler);
    const Coupler& coupler = model_.couplers[c];
    const CouplerTerms& at = terms_->couplers[c];
    const joints::CoordinateValue value = joints::evaluate(
        joints::coordinates_of(coupler.law)[index(term.coordinate)], at.motion,
        state_->memory[c].near[index(term.coordinate)]);
    const MotionChange& change = motions_[c];
    Vector6 d_gradient = Vector6::Zero();
    d_gradient.tail<3>() =
        term.factor * (value.hessian * change.position.tail<3>());
    d_z += terms.gradients[i].dot(change.position);
    d_rate += terms.gradients[i].dot(change.velocity) +
              d_gradient.tail<3>().dot(at.motion.w_FM_F);
    change_pair(coupler, at, change, terms.applied * terms.gradients[i],
                terms.applied * d_gradient, x, r);
  }
  law[0] = -terms.response.damping * (d_rate - c_.velocity * d_z);
}

void ResidualDerivative::apply_rest(const VectorX& increments,
                                    VectorX& residual,
                                    std::vector<Vector6>& laws) {
  residual.setZero(increments.size());
  laws.resize(model_.couplers.size() + model_.transmissions.size());
  find_moved(increments);
  for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
    if (is_moved_[b] != 0) change_inertia(b, increments, residual);
  }
  change_frames(increments);
  change_couplers(increments, residual, laws);
  change_pairs(increments, residual);
  for (const Load& load : model_.loads) {
    change_load(load, increments, residual);
  }
  for (const BodyLoad& load : model_.body_loads) {
    change_body_load(load, increments, residual);
  }
}

}  // namespace limber::dynamics
