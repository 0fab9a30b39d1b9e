// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "limber/dynamics/bodies/load_on_frame.hpp"
#include "limber/dynamics/bodies/nodal_body.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/terms/mean_frame.hpp"

/// The equations of an unreduced body.
namespace limber::dynamics {
namespace {

// Damping of the deformation's part in the reduced modes: the rate of that
// part is (M Phi)^T R^T (v less the rigid motion), linear in v, and C times it
// is mapped back by the transpose. So there is no net force or moment at any
// deformation, and the power is that of the rate.
// @returns the dissipated power [W]
double add_damping(const FullModel& full, bool is_clamped,
                   const SystemState& state, FullTerms& t) {
  const ConstNodes u = nodes_of(full, state.u_H);
  const ConstNodes udot = nodes_of(full, state.udot_H);
  const Matrix3 R_BH = t.frame.R_HB.transpose();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 b = full.mesh->x_B.col(i) + u.col(i) - t.frame.p_HB;
    const Vector3 relative = udot.col(i) - t.frame.v_H - t.frame.w_H.cross(b);
    t.scratch.col(i) = R_BH * relative;
  }
  t.modal_rate.noalias() = full.damped_modes.transpose() * t.scratch.reshaped();
  const double dissipated =
      (full.damping.array() * t.modal_rate.array().square()).sum();
  t.modal_rate.array() *= full.damping.array();
  t.scratch.reshaped().noalias() = full.damped_modes * t.modal_rate;
  Vector3 force = Vector3::Zero();
  Vector3 moment = Vector3::Zero();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 f = t.frame.R_HB * t.scratch.col(i);
    const Vector3 arm = full.mesh->x_B.col(i) + u.col(i) - t.frame.center_H;
    t.force.col(i) -= f;
    force += f;
    moment += arm.cross(f);
  }
  if (!is_clamped) {
    add_mean_wrench(*full.mesh, t.frame, force, moment, t.force);
  }
  return dissipated;
}

// f_n = R_HB Phi_n' force_B of each node.
template <typename Field>
void add_to_nodes(const joints::PairPlace& place, const Matrix3& R_HB,
                  const Vector3& force_B, Field&& force_H) {
  for (Eigen::Index n = 0; n < force_H.cols(); ++n) {
    const Vector3 fraction =
        place.Phi_B.middleCols<3>(3 * n).transpose() * force_B;
    force_H.col(n) += R_HB * fraction;
  }
}

}  // namespace

void NodalBody::append_terms(SystemTerms& terms) const {
  BodyTerms rigid;
  rigid.R_WB.setIdentity();
  rigid.J = body_.J0;
  rigid.bias_r.setZero();
  rigid.force_W.setZero();
  rigid.moment_B.setZero();
  terms.bodies.push_back(std::move(rigid));
  const Eigen::Index nodes = full().mesh->node_count();
  FullTerms t;
  t.solver = full().mesh->make_solver();
  t.internal = t.force = t.scratch = Matrix3X::Zero(3, nodes);
  t.modal_rate = VectorX::Zero(full().damping.size());
  terms.full.push_back(std::move(t));
}

void NodalBody::size_attachment(const Attachment& /*attachment*/,
                                AttachmentMotion& motion,
                                SystemTerms& terms) const {
  motion.nodal = static_cast<int>(terms.nodal_frames.size());
  terms.nodal_frames.emplace_back();
}

ProductTerms NodalBody::make_products() const {
  const Eigen::Index size = count_pair_coordinates(model_, BodyIndex(b_));
  return {VectorX(), VectorX::Zero(size), VectorX::Zero(size)};
}

void NodalBody::calc_inertia(const SystemState& state,
                             SystemTerms& terms) const {
  FullTerms& t = terms.full[f()];
  BodyTerms& rigid = terms.bodies[b_];
  const Vector3& w = state.bodies[b_].w_WB_B;
  rigid.bias_r = w.cross(body_.J0 * w);
  t.strain_energy = name_failures(body_, state.t, [&] {
    return t.solver->calc_internal_force(nodes_of(full(), state.u_H),
                                         t.internal);
  });
  if (full().needs_frame) calc_mean_frame(model_, full(), state, t.frame);
  rigid.R_WB = state.X_WH[f()].R * t.frame.R_HB;
}

void NodalBody::reset_forces(const SystemState& state,
                             SystemTerms& terms) const {
  FullTerms& t = terms.full[f()];
  BodyTerms& own = terms.bodies[b_];
  own.supplied = own.dissipated = 0.0;
  t.force.setZero();
  if (full().damping.size() > 0) {
    own.dissipated = add_damping(full(), body_.clamped, state, t);
  }
  if (model_.gravity_W.isZero(0.0)) return;
  const Vector3 gravity_H = state.X_WH[f()].R.transpose() * model_.gravity_W;
  t.force.noalias() += gravity_H * full().mesh->node_mass.transpose();
  own.supplied +=
      gravity_H.dot(nodes_of(full(), state.udot_H) * full().mesh->node_mass);
}

void NodalBody::clear_forces(SystemTerms& terms) const {
  terms.full[f()].force.setZero();
  terms.full[f()].internal.setZero();
}

void NodalBody::calc_attachment(const Attachment& attachment,
                                const SystemState& state, SystemTerms& terms,
                                AttachmentMotion& motion) const {
  calc_nodal_attachment(full(), state.X_WH[f()], attachment, state,
                        terms.nodal_frames[index(motion.nodal)], motion);
}

FrameMotion NodalBody::find_frame(const Attachment& attachment,
                                  const SystemState& state) const {
  NodalFrameMotion nodal;
  AttachmentMotion motion;
  calc_nodal_attachment(full(), state.X_WH[f()], attachment, state, nodal,
                        motion);
  return frame_motion(motion);
}

void NodalBody::add_wrench(const Attachment& attachment,
                           AttachmentMotion& motion, const Vector3& force_W,
                           const Vector3& moment_W, SystemTerms& terms) const {
  const NodalFrameMotion& nodal = terms.nodal_frame(motion);
  const Matrix3 R_HW = nodal.R_HB * motion.R_WB.transpose();
  add_nodal_wrench(*attachment.nodal, nodal, R_HW * force_W, R_HW * moment_W,
                   terms.full[f()].force);
}

void NodalBody::add_load(const Load& load, double factor,
                         const SystemState& /*state*/,
                         SystemTerms& terms) const {
  add_load_on_frame(*this, model_, load, factor, terms, terms.bodies[b_]);
}

void NodalBody::add_nodal_load(const BodyLoad& load, Eigen::Index i,
                               const SystemState& state,
                               SystemTerms& terms) const {
  FullTerms& t = terms.full[f()];
  const ConstNodes udot = nodes_of(full(), state.udot_H);
  const ConstNodes pattern(load.nodal.col(i).data(), 3, udot.cols());
  for (Eigen::Index n = 0; n < udot.cols(); ++n) {
    const Vector3 force = t.frame.R_HB * pattern.col(n);
    t.force.col(n) += force;
    terms.bodies[b_].supplied += force.dot(udot.col(n));
  }
}

void NodalBody::set_pair_body(const SystemState& state, ProductTerms& own,
                              joints::PairBody& out) const {
  MeanFrame frame;
  calc_mean_frame(model_, full(), state, frame);
  set_pair_body(state, frame, own, out);
}

void NodalBody::set_pair_body(const SystemState& state,
                              const SystemTerms& terms, ProductTerms& own,
                              joints::PairBody& out) const {
  set_pair_body(state, terms.full[f()].frame, own, out);
}

void NodalBody::set_pair_body(const SystemState& state, const MeanFrame& frame,
                              ProductTerms& own, joints::PairBody& out) const {
  const Pose& X_WH = state.X_WH[f()];
  const Matrix3 R_BH = frame.R_HB.transpose();
  out.R_WB = X_WH.R * frame.R_HB;
  out.p_WB = X_WH * frame.p_HB;
  out.v_WB_W = X_WH.R * frame.v_H;
  out.w_WB_B = R_BH * frame.w_H;
  const ConstNodes u_H = nodes_of(full(), state.u_H);
  const ConstNodes udot_H = nodes_of(full(), state.udot_H);
  double most_u = 0.0;
  double most_udot = 0.0;
  for (Eigen::Index n = 0; n < u_H.cols(); ++n) {
    const Vector3 arm_H = full().mesh->x_B.col(n) + u_H.col(n) - frame.p_HB;
    const Vector3 deformed = R_BH * arm_H - full().mesh->x_B.col(n);
    const Vector3 rate =
        R_BH * (udot_H.col(n) - frame.v_H - frame.w_H.cross(arm_H));
    own.eta.segment<3>(3 * n) = deformed;
    own.etadot.segment<3>(3 * n) = rate;
    most_u = std::max(most_u, deformed.norm());
    most_udot = std::max(most_udot, rate.norm());
  }
  own.eta[full().dofs()] = most_u;
  own.etadot[full().dofs()] = most_udot;
  out.modes = static_cast<int>(full().dofs() + 1);
  out.eta = own.eta.data();
  out.etadot = own.etadot.data();
}

void NodalBody::add_force(const PairForce& force, SystemTerms& terms) const {
  const joints::PairBody& moving = terms.pairs.bodies[b_];
  add_to_nodes(force.place, terms.full[f()].frame.R_HB,
               moving.R_WB.transpose() * force.force_W, terms.full[f()].force);
}

void NodalBody::add_force_residual(const PairForce& force,
                                   const SystemTerms& terms,
                                   VectorX& residual) const {
  const joints::PairBody& moving = terms.pairs.bodies[b_];
  add_to_nodes(force.place, terms.full[f()].frame.R_HB,
               -(moving.R_WB.transpose() * force.force_W),
               nodal_rows(model_, full(), residual));
}

void NodalBody::complete_forces(const SystemState& state,
                                SystemTerms& terms) const {
  const ConstNodes udot = nodes_of(full(), state.udot_H);
  BodyTerms& t = terms.bodies[b_];
  t.received = terms.full[f()].force.cwiseProduct(udot).sum() + t.dissipated -
               t.supplied;
}

void NodalBody::solve_acceleration(const SystemTerms& terms,
                                   VectorX& accelerations) const {
  const FullTerms& t = terms.full[f()];
  accelerations.segment<6>(body_.row).setZero();
  t.solver->divide_mass(t.force - t.internal,
                        nodal_rows(model_, full(), accelerations));
}

void NodalBody::calc_residual(const VectorX& acceleration, SystemTerms& terms,
                              VectorX& residual) const {
  FullTerms& t = terms.full[f()];
  residual.segment<6>(body_.row).setZero();
  Nodes rows = nodal_rows(model_, full(), residual);
  t.solver->multiply_mass(nodal_rows(model_, full(), acceleration), t.scratch);
  rows = t.scratch + t.internal - t.force;
  for (Eigen::Index n = 0; n < rows.cols(); ++n) {
    if (full().mesh->held[static_cast<std::size_t>(n)] != 0)
      rows.col(n).setZero();
  }
}

double NodalBody::find_elastic_energy(const SystemState& /*state*/,
                                      const SystemTerms& terms) const {
  return terms.full[f()].strain_energy;
}

void NodalBody::add_energy(const SystemState& state, SystemTerms& terms,
                           EnergyBalance& balance) const {
  FullTerms& t = terms.full[f()];
  const ConstNodes udot = nodes_of(full(), state.udot_H);
  t.solver->multiply_mass(udot, t.scratch);  // momenta
  const double kinetic = 0.5 * t.scratch.cwiseProduct(udot).sum();
  if (body_.clamped) {
    balance.kinetic_modal += kinetic;
    return;
  }
  MeanFrame frame;
  calc_mean_frame(model_, full(), state, frame);
  const Matrix3X& x = full().mesh->x_B;
  const ConstNodes u = nodes_of(full(), state.u_H);
  const double mass = full().mesh->node_mass.sum();
  const Vector3 momentum = t.scratch.rowwise().sum();
  const Vector3 center = (x + u) * full().mesh->node_mass / mass;
  Vector3 spin = Vector3::Zero();  // about the centre of mass
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 arm = x.col(i) + u.col(i) - center;
    const Vector3 p = t.scratch.col(i);
    spin += arm.cross(p);
  }
  const Matrix3X arms = (x + u).colwise() - center;
  t.solver->multiply_mass(arms, t.scratch);
  const Matrix3 S = t.scratch * arms.transpose();
  const Matrix3 J = S.trace() * Matrix3::Identity() - S;
  const double rigid =
      0.5 * momentum.squaredNorm() / mass + 0.5 * frame.w_H.dot(J * frame.w_H);
  balance.kinetic_rigid += rigid;
  balance.kinetic_modal += kinetic - rigid;
  const Pose& X_WH = state.X_WH[f()];
  const Vector3 momentum_W = X_WH.R * momentum;
  balance.linear_momentum += momentum_W;
  balance.angular_momentum += (X_WH * center).cross(momentum_W) + X_WH.R * spin;
}

}  // namespace limber::dynamics
