// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/full_terms.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/system/unknowns.hpp"

namespace limber::dynamics {
namespace {

// Damping of the deformation's part in the reduced modes: the rate of that
// part is (M Phi)^T R^T (v less the rigid motion), linear in v, and C times it
// is mapped back by the transpose. So there is no net force or moment at any
// deformation, and the power is that of the rate.
void add_damping(const SystemModel& model, const FullModel& full,
                 const SystemState& state, FullTerms& t, SystemTerms& terms) {
  const ConstNodes u = nodes_of(full, state.u_H);
  const ConstNodes udot = nodes_of(full, state.udot_H);
  const Matrix3 R_BH = t.frame.R_HB.transpose();
  for (Eigen::Index i = 0; i < u.cols(); ++i) {
    const Vector3 b = full.mesh->x_B.col(i) + u.col(i) - t.frame.p_HB;
    const Vector3 relative = udot.col(i) - t.frame.v_H - t.frame.w_H.cross(b);
    t.scratch.col(i) = R_BH * relative;
  }
  t.modal_rate.noalias() = full.damped_modes.transpose() * t.scratch.reshaped();
  terms.bodies[index(full.body)].dissipated +=
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
  if (!model.bodies[index(full.body)].clamped) {
    add_mean_wrench(*full.mesh, t.frame, force, moment, t.force);
  }
}

}  // namespace

void calc_full_terms(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    FullTerms& t = terms.full[f];
    t.strain_energy = name_failures(model, full, state.t, [&] {
      return t.solver->calc_internal_force(nodes_of(full, state.u_H),
                                           t.internal);
    });
    if (full.needs_frame) calc_mean_frame(model, full, state, t.frame);
    terms.bodies[index(full.body)].R_WB = state.X_WH[f].R * t.frame.R_HB;
  }
}

void reset_full_forces(const SystemModel& model, const SystemState& state,
                       SystemTerms& terms) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    FullTerms& t = terms.full[f];
    t.force.setZero();
    if (full.damping.size() > 0) add_damping(model, full, state, t, terms);
    if (model.gravity_W.isZero(0.0)) continue;
    const Vector3 gravity_H = state.X_WH[f].R.transpose() * model.gravity_W;
    t.force.noalias() += gravity_H * full.mesh->node_mass.transpose();
    terms.bodies[index(full.body)].supplied +=
        gravity_H.dot(nodes_of(full, state.udot_H) * full.mesh->node_mass);
  }
}

void add_full_wrench(const SystemModel& model, const Attachment& attachment,
                     const AttachmentMotion& motion, const Vector3& force_W,
                     const Vector3& moment_W, SystemTerms& terms) {
  const auto f = index(model.bodies[index(attachment.body)].full);
  const NodalFrameMotion& nodal = terms.nodal_frame(motion);
  const Matrix3 R_HW = nodal.R_HB * motion.R_WB.transpose();
  add_nodal_wrench(*attachment.nodal, nodal, R_HW * force_W, R_HW * moment_W,
                   terms.full[f].force);
}

void add_full_nodal_load(const SystemModel& model, const BodyLoad& load,
                         Eigen::Index i, const SystemState& state,
                         SystemTerms& terms) {
  const auto f = index(model.bodies[index(load.body)].full);
  const FullModel& full = model.full_bodies[f];
  FullTerms& t = terms.full[f];
  const ConstNodes udot = nodes_of(full, state.udot_H);
  const ConstNodes pattern(load.nodal.col(i).data(), 3, udot.cols());
  for (Eigen::Index n = 0; n < udot.cols(); ++n) {
    const Vector3 force = t.frame.R_HB * pattern.col(n);
    t.force.col(n) += force;
    terms.bodies[index(load.body)].supplied += force.dot(udot.col(n));
  }
}

void solve_full_accelerations(const SystemModel& model,
                              const SystemTerms& terms,
                              VectorX& accelerations) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullTerms& t = terms.full[f];
    t.solver->divide_mass(
        t.force - t.internal,
        nodal_rows(model, model.full_bodies[f], accelerations));
  }
}

void calc_full_residual(const FullModel& full, const ConstNodes& uddot_H,
                        FullTerms& terms, Nodes residual) {
  terms.solver->multiply_mass(uddot_H, terms.scratch);
  residual = terms.scratch + terms.internal - terms.force;
  for (Eigen::Index n = 0; n < residual.cols(); ++n) {
    if (full.mesh->held[static_cast<std::size_t>(n)] != 0) {
      residual.col(n).setZero();
    }
  }
}

}  // namespace limber::dynamics
