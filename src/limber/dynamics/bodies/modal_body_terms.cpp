// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/load_on_frame.hpp"
#include "limber/dynamics/bodies/modal_body.hpp"
#include "limber/dynamics/bodies/modal_coordinates.hpp"
#include "limber/dynamics/bodies/modal_forces.hpp"
#include "limber/dynamics/kernels/inertia_kernel.hpp"
#include "limber/dynamics/kernels/padding.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/interpolation.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/dynamics/terms/maxwell.hpp"
#include "limber/flexbody/model/mode_products.hpp"

/// The equations of a modal body, at each of its levels.
namespace limber::dynamics {
namespace {

using ConstModes = Eigen::Map<const VectorX>;

ConstModes modes_of(const BodyModel& body, const VectorX& all) {
  return {all.data() + body.offset, body.modes};
}

// Elastic and damping forces, at every flexible level.
void set_oscillator_bias(const BodyModel& body, const SystemState& state,
                         BodyTerms& terms) {
  const ConstModes eta = modes_of(body, state.eta);
  const ConstModes etadot = modes_of(body, state.etadot);
  if (const VectorX* lambda = flexbody::find_eigenvalues(body.elasticity)) {
    terms.bias_e.array() =
        lambda->array() * eta.array() + body.damping.array() * etadot.array();
  } else {
    flexbody::calc_elastic_force(body.elasticity, eta, terms.bias_e);
    terms.bias_e.array() += body.damping.array() * etadot.array();
  }
  add_maxwell_force(body, state.maxwell, terms.bias_e);
}

// Level one-way: centrifugal force of the undeformed body. (Its Euler force
// vanishes: int phi x x dm = 0 in the mean-axis frame.)
void add_centrifugal_bias(const BodyModel& body, const Vector3& w,
                          BodyTerms& terms) {
  terms.bias_e.noalias() -= body.inertia->J1() * half_square(w);
}

// Level coupled: all terms, O(m^2).
void set_coupled_terms(const BodyModel& body, const SystemState& state,
                       const Vector3& w, BodyTerms& terms) {
  const Vector6 w_squared = half_square(w);
  const kernels::InertiaSums sums = kernels::calc_inertia(
      {body.inertia->columns.data(), static_cast<std::size_t>(body.modes)},
      state.eta.data() + body.offset, state.etadot.data() + body.offset,
      w.data(), w_squared.data(), terms.by_mode.data(), terms.bias_e.data());
  const Vector6 J = Eigen::Map<const Vector6>(sums.J.data());
  const Vector6 Jdot = Eigen::Map<const Vector6>(sums.Jdot.data());
  const Vector3 h = Eigen::Map<const Vector3>(sums.h.data());  // H etadot
  terms.J = body.J0 + unpack_symmetric(J);
  terms.bias_r = unpack_symmetric(Jdot) * w + w.cross(terms.J * w + h);
}

// A load on the undeformed body, for levels without feedback. Linear in the
// modes, so that a closed-form response exists.
void apply_to_undeformed(const BodyModel& body, const Attachment& attachment,
                         const SystemState& state, const BodyState& rigid,
                         const Vector3& force_B, const Vector3& moment_B,
                         BodyTerms& t) {
  for (int k = 0; k < body.modes; ++k) {
    const double force = attachment.Phi_B.col(k).dot(force_B) +
                         attachment.Psi_B.col(k).dot(moment_B);
    t.modal_force[k] += force;
    t.supplied += force * state.etadot[body.offset + k];
  }
  if (body.clamped) return;
  const Vector3 force_W = t.R_WB * force_B;
  const Vector3 about_center = attachment.p_BF.cross(force_B) + moment_B;
  t.force_W += force_W;
  t.moment_B += about_center;
  t.supplied += force_W.dot(rigid.v_WB_W) + about_center.dot(rigid.w_WB_B);
}

// Gravity deforms a clamped body; it only accelerates a free one.
void add_gravity_on_modes(const SystemModel& model, const BodyModel& body,
                          const SystemState& state, BodyTerms& t,
                          ProductTerms& products) {
  if (model.gravity_W.isZero(0.0)) return;
  const Vector3 gravity_B = t.R_WB.transpose() * model.gravity_W;
  for (int k = 0; k < body.modes; ++k) {
    const double force = body.P.col(k).dot(gravity_B);
    t.modal_force[k] += force;
    t.supplied += force * state.etadot[body.offset + k];
  }
  const double* eta = state.eta.data() + body.offset;
  const double* etadot = state.etadot.data() + body.offset;
  flexbody::for_each_product(paired_of(body), [&](Eigen::Index pair, int i,
                                                  int j, bool is_square) {
    const double force = body.P.col(body.modes + pair).dot(gravity_B);
    products.force[pair] += force;
    t.supplied += force * (is_square ? eta[i] * etadot[i]
                                     : eta[i] * etadot[j] + eta[j] * etadot[i]);
  });
}

}  // namespace

void ModalBody::append_terms(SystemTerms& terms) const {
  const int m = body_.modes;
  BodyTerms t;
  t.R_WB.setIdentity();
  t.J = body_.J0;
  t.bias_r.setZero();
  t.bias_e = VectorX::Zero(m);
  t.force_W.setZero();
  t.moment_B.setZero();
  t.modal_force = VectorX::Zero(m);
  if (has_dense_modes(body_)) t.stiffness = MatrixX::Zero(m, m);
  const auto padded =
      static_cast<Eigen::Index>(kernels::pad(static_cast<std::size_t>(m)));
  t.by_mode.setZero(padded, 12);
  terms.bodies.push_back(std::move(t));
}

void ModalBody::size_attachment(const Attachment& attachment,
                                AttachmentMotion& motion,
                                SystemTerms& /*terms*/) const {
  if (!attachment.second) return;
  motion.Phi_B = attachment.Phi_B;
  motion.Psi_B = attachment.Psi_B;
  motion.wrench_B.setZero();
}

ProductTerms ModalBody::make_products() const {
  if (paired_of(body_).empty()) return {};
  const int size = count_coordinates(body_);
  return {VectorX::Zero(size - body_.modes), VectorX::Zero(size),
          VectorX::Zero(size)};
}

void ModalBody::calc_inertia(const SystemState& state,
                             SystemTerms& terms) const {
  const Vector3& w = state.bodies[b_].w_WB_B;
  BodyTerms& t = terms.bodies[b_];
  t.R_WB = state.bodies[b_].quat_WB.toRotationMatrix();
  if (body_.modes > 0) set_oscillator_bias(body_, state, t);
  if (body_.modes > 0 && !body_.clamped && is_coupled(body_.fidelity)) {
    set_coupled_terms(body_, state, w, t);
    return;
  }
  t.bias_r = w.cross(body_.J0 * w);
  if (is_one_way(body_) && !body_.clamped) add_centrifugal_bias(body_, w, t);
}

void ModalBody::reset_forces(const SystemState& state,
                             SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  ProductTerms& products = terms.products[b_];
  t.supplied = t.dissipated = 0.0;
  t.force_W.setZero();
  if (body_.has_rigid_motion()) {
    t.force_W = body_.mass * model_.gravity_W;
    t.supplied += t.force_W.dot(state.bodies[b_].v_WB_W);
  }
  t.moment_B.setZero();
  t.modal_force.setZero();
  products.force.setZero();
  if (body_.modes == 0) return;
  if (body_.clamped) add_gravity_on_modes(model_, body_, state, t, products);
  const ConstModes etadot = modes_of(body_, state.etadot);
  t.dissipated += (body_.damping.array() * etadot.array().square()).sum() +
                  find_maxwell_loss(body_, state.maxwell);
}

void ModalBody::clear_forces(SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  t.force_W.setZero();
  t.moment_B.setZero();
  t.modal_force.setZero();
  t.bias_r.setZero();
  t.bias_e.setZero();
}

void ModalBody::calc_attachment(const Attachment& attachment,
                                const SystemState& state, SystemTerms& terms,
                                AttachmentMotion& motion) const {
  calc_attachment_motion(body_, attachment, state, terms.bodies[b_].R_WB,
                         motion);
}

FrameMotion ModalBody::find_frame(const Attachment& attachment,
                                  const SystemState& state) const {
  AttachmentMotion motion;
  calc_attachment_motion(body_, attachment, state,
                         state.bodies[b_].quat_WB.toRotationMatrix(), motion);
  return frame_motion(motion);
}

void ModalBody::add_wrench(const Attachment& attachment,
                           AttachmentMotion& motion, const Vector3& force_W,
                           const Vector3& moment_W, SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  const Vector3 force_B = motion.R_WB.transpose() * force_W;
  const Vector3 moment_B = motion.R_WB.transpose() * moment_W;
  t.force_W += force_W;
  t.moment_B += motion.arm_B.cross(force_B) + moment_B;
  if (body_.modes == 0) return;
  const Vector3 twist_B = motion.J_psi.transpose() * moment_B;
  kernels::add_interface_force(columns_of(translation_of(attachment, motion),
                                          rotation_of(attachment, motion)),
                               force_B.data(), twist_B.data(),
                               t.modal_force.data());
  if (!attachment.second) return;
  motion.wrench_B.head<3>() += force_B;
  motion.wrench_B.tail<3>() += twist_B;
}

void ModalBody::add_load(const Load& load, double factor,
                         const SystemState& state, SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  if (is_coupled(body_.fidelity)) {
    add_load_on_frame(*this, model_, load, factor, terms, t);
    return;
  }
  const Vector3 force = factor * load.force;
  const Vector3 moment = factor * load.moment;
  const Matrix3 R = load.in_world ? Matrix3(t.R_WB.transpose())
                                  : Matrix3(Matrix3::Identity());
  apply_to_undeformed(body_, model_.attachments[index(load.where)], state,
                      state.bodies[b_], R * force, R * moment, t);
}

void ModalBody::add_nodal_load(const BodyLoad& load, Eigen::Index i,
                               const SystemState& state,
                               SystemTerms& terms) const {
  const flexbody::NodalLoad& history = load.history;
  const BodyState& rigid = state.bodies[b_];
  BodyTerms& t = terms.bodies[b_];
  const double* eta = state.eta.data() + body_.offset;
  const double* etadot = state.etadot.data() + body_.offset;
  const Vector3 force_W = t.R_WB * history.force.col(i);
  Vector3 moment_B = history.moment.col(i);
  const Eigen::Index first = i * count_coordinates(body_);
  for (int k = 0; k < body_.modes; ++k) {
    if (is_coupled(body_.fidelity)) {
      moment_B += history.moment_by_mode.col(first + k) * eta[k];
    }
    t.modal_force[k] += history.modal(k, i);
    t.supplied += history.modal(k, i) * etadot[k];
  }
  flexbody::for_each_product(paired_of(body_), [&](Eigen::Index pair, int k,
                                                   int l, bool is_square) {
    const double force = history.modal(body_.modes + pair, i);
    terms.products[b_].force[pair] += force;
    moment_B += history.moment_by_mode.col(first + body_.modes + pair) *
                ((is_square ? 0.5 : 1.0) * eta[k] * eta[l]);
    t.supplied += force * (is_square ? eta[k] * etadot[k]
                                     : eta[k] * etadot[l] + eta[l] * etadot[k]);
  });
  if (body_.clamped) return;
  t.force_W += force_W;
  t.moment_B += moment_B;
  t.supplied += force_W.dot(rigid.v_WB_W) + moment_B.dot(rigid.w_WB_B);
}

void ModalBody::set_pair_body(const SystemState& state, ProductTerms& own,
                              joints::PairBody& out) const {
  set_pair_body(state, state.bodies[b_].quat_WB.toRotationMatrix(), own, out);
}

void ModalBody::set_pair_body(const SystemState& state,
                              const SystemTerms& terms, ProductTerms& own,
                              joints::PairBody& out) const {
  set_pair_body(state, terms.bodies[b_].R_WB, own, out);
}

void ModalBody::set_pair_body(const SystemState& state, const Matrix3& R_WB,
                              ProductTerms& own, joints::PairBody& out) const {
  const BodyState& rigid = state.bodies[b_];
  out.R_WB = R_WB;
  out.p_WB = rigid.p_WB;
  out.v_WB_W = rigid.v_WB_W;
  out.w_WB_B = rigid.w_WB_B;
  const double* eta = state.eta.data() + body_.offset;
  const double* etadot = state.etadot.data() + body_.offset;
  out.modes = count_coordinates(body_);
  out.eta = eta;
  out.etadot = etadot;
  if (paired_of(body_).empty()) return;
  set_modal_coordinates(body_, state, own.eta.data());
  own.etadot.head(body_.modes) = modes_of(body_, state.etadot);
  flexbody::set_product_rates(paired_of(body_), eta, etadot,
                              own.etadot.data() + body_.modes);
  out.eta = own.eta.data();
  out.etadot = own.etadot.data();
}

void ModalBody::add_force(const PairForce& force, SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  const Vector3 force_B = t.R_WB.transpose() * force.force_W;
  t.force_W += force.force_W;
  t.moment_B += force.arm_B.cross(force_B);
  add_modal_force(body_, force.place, force_B, t, terms.products[b_]);
}

void ModalBody::add_force_residual(const PairForce& force,
                                   const SystemTerms& terms,
                                   VectorX& residual) const {
  const Vector3 force_B = terms.bodies[b_].R_WB.transpose() * force.force_W;
  add_modal_residual(body_, force.place, terms.pairs.bodies[b_].eta, force_B,
                     residual.data() + body_.row + 6);
  if (!body_.has_rigid_motion()) return;
  translation_rows(body_, residual) -= force.force_W;
  rotation_rows(body_, residual) -= force.arm_B.cross(force_B);
}

// Power of all forces but loads and gravity, whose own is known already. With
// the velocities of these forces, so that powers of a coupler and of the bodies
// that it joins cancel at states that are not solutions either.
void ModalBody::complete_forces(const SystemState& state,
                                SystemTerms& terms) const {
  BodyTerms& t = terms.bodies[b_];
  add_product_forces(body_, state, terms.products[b_], t);
  t.received = t.modal_force.dot(modes_of(body_, state.etadot)) - t.supplied;
  if (!body_.has_rigid_motion()) return;
  const BodyState& rigid = state.bodies[b_];
  t.received += t.force_W.dot(rigid.v_WB_W) + t.moment_B.dot(rigid.w_WB_B);
}

void ModalBody::solve_acceleration(const SystemTerms& terms,
                                   VectorX& accelerations) const {
  const BodyTerms& t = terms.bodies[b_];
  auto etaddot = mode_rows(body_, accelerations);
  etaddot = t.modal_force - t.bias_e;
  if (!body_.has_rigid_motion()) {
    accelerations.segment<6>(body_.row).setZero();
    return;
  }
  translation_rows(body_, accelerations) = t.force_W / body_.mass;
  Matrix3 schur = t.J;
  Vector3 right = t.moment_B - t.bias_r;
  for (int k = 0; k < body_.modes; ++k) {
    const Vector3 H = t.H().col(k);
    schur -= H * H.transpose();
    right -= H * etaddot[k];
  }
  const Vector3 dw = schur.inverse() * right;
  rotation_rows(body_, accelerations) = dw;
  for (int k = 0; k < body_.modes; ++k) etaddot[k] -= t.H().col(k).dot(dw);
}

void ModalBody::calc_residual(const VectorX& acceleration, SystemTerms& terms,
                              VectorX& residual) const {
  const BodyTerms& t = terms.bodies[b_];
  auto translation = translation_rows(body_, residual);
  auto rotation = rotation_rows(body_, residual);
  translation.setZero();
  rotation.setZero();
  const Vector3 dw = rotation_rows(body_, acceleration);
  if (body_.has_rigid_motion()) {
    translation =
        body_.mass * translation_rows(body_, acceleration) - t.force_W;
    rotation = t.J * dw + t.bias_r - t.moment_B;
  }
  const auto etaddot = mode_rows(body_, acceleration);
  const auto H = t.by_mode.middleCols<3>(6).topRows(body_.modes);
  for (int i = 0; i < 3; ++i) rotation[i] += H.col(i).dot(etaddot);
  mode_rows(body_, residual) = etaddot + t.bias_e - t.modal_force +
                               H.col(0) * dw[0] + H.col(1) * dw[1] +
                               H.col(2) * dw[2];
  if (body_.clamped) rotation.setZero();
}

double ModalBody::find_elastic_energy(const SystemState& state,
                                      const SystemTerms& /*terms*/) const {
  return flexbody::calc_elastic_energy(body_.elasticity,
                                       modes_of(body_, state.eta)) +
         find_maxwell_energy(body_, state.maxwell);
}

void ModalBody::add_energy(const SystemState& state, SystemTerms& terms,
                           EnergyBalance& balance) const {
  const BodyState& rigid = state.bodies[b_];
  const BodyTerms& t = terms.bodies[b_];
  const auto etadot = state.etadot.segment(body_.offset, body_.modes);
  balance.kinetic_modal += 0.5 * etadot.squaredNorm();
  if (!body_.has_rigid_motion()) return;
  const Vector3 h = t.H() * etadot;
  const Vector3 spin_B = t.J * rigid.w_WB_B + h;
  balance.kinetic_modal += rigid.w_WB_B.dot(h);
  balance.kinetic_rigid += 0.5 * body_.mass * rigid.v_WB_W.squaredNorm() +
                           0.5 * rigid.w_WB_B.dot(t.J * rigid.w_WB_B);
  const Vector3 momentum = body_.mass * rigid.v_WB_W;
  balance.linear_momentum += momentum;
  balance.angular_momentum += rigid.p_WB.cross(momentum) + t.R_WB * spin_B;
}

}  // namespace limber::dynamics
