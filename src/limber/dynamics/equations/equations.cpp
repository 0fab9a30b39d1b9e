// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/equations.hpp"

#include "limber/common/index.hpp"
#include "limber/dynamics/equations/coupler_forces.hpp"
#include "limber/dynamics/equations/full_terms.hpp"
#include "limber/dynamics/terms/maxwell.hpp"
#include "limber/dynamics/equations/pair_forces.hpp"
#include "limber/dynamics/equations/transmission.hpp"
#include "limber/dynamics/kernels/inertia_kernel.hpp"
#include "limber/dynamics/kernels/padding.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/flexbody/model/mode_products.hpp"

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

void apply_load(const SystemModel& model, const SystemState& state,
                const Load& load, Side side, SystemTerms& terms) {
  const double factor = evaluate(load.function, now_of(state, side));
  if (factor == 0.0) return;
  const auto i = static_cast<std::size_t>(load.where);
  const Attachment& attachment = model.attachments[i];
  if (attachment.body == kWorld) return;
  const auto b = static_cast<std::size_t>(attachment.body);
  const BodyModel& body = model.bodies[b];
  BodyTerms& t = terms.bodies[b];

  const Vector3 force = factor * load.force;
  const Vector3 moment = factor * load.moment;
  if (body.fidelity < Fidelity::coupled) {
    const Matrix3 R = load.in_world ? Matrix3(t.R_WB.transpose())
                                    : Matrix3(Matrix3::Identity());
    apply_to_undeformed(body, attachment, state, state.bodies[b], R * force,
                        R * moment, t);
    return;
  }
  const AttachmentMotion& motion = terms.attachments[i];
  const Vector3 force_W = load.in_world ? force : t.R_WB * force;
  const Vector3 moment_W = load.in_world ? moment : t.R_WB * moment;
  add_wrench(model, load.where, force_W, moment_W, terms);
  t.supplied += force_W.dot(motion.v_WF_W) + moment_W.dot(motion.w_WF_W);
}

void apply_body_load(const SystemModel& model, const SystemState& state,
                     const BodyLoad& load, Side side, SystemTerms& terms) {
  const flexbody::NodalLoad& history = load.history;
  const Eigen::Index i = find_interval(history.times, state.t, side);
  if (i < 0) return;
  const auto b = static_cast<std::size_t>(load.body);
  const BodyModel& body = model.bodies[b];
  if (body.full >= 0) {
    add_full_nodal_load(model, load, i, state, terms);
    return;
  }
  const BodyState& rigid = state.bodies[b];
  BodyTerms& t = terms.bodies[b];
  const Vector3 force_W = t.R_WB * history.force.col(i);
  Vector3 moment_B = history.moment.col(i);
  const Eigen::Index first = i * count_coordinates(body);
  for (int k = 0; k < body.modes; ++k) {
    if (is_coupled(body.fidelity)) {
      moment_B +=
          history.moment_by_mode.col(first + k) * state.eta[body.offset + k];
    }
    t.modal_force[k] += history.modal(k, i);
    t.supplied += history.modal(k, i) * state.etadot[body.offset + k];
  }
  const double* eta = state.eta.data() + body.offset;
  const double* etadot = state.etadot.data() + body.offset;
  flexbody::for_each_product(paired_of(body), [&](Eigen::Index pair, int k,
                                                  int l, bool is_square) {
    const double force = history.modal(body.modes + pair, i);
    terms.products[b].force[pair] += force;
    moment_B += history.moment_by_mode.col(first + body.modes + pair) *
                ((is_square ? 0.5 : 1.0) * eta[k] * eta[l]);
    t.supplied += force * (is_square ? eta[k] * etadot[k]
                                     : eta[k] * etadot[l] + eta[l] * etadot[k]);
  });
  if (body.clamped) return;
  t.force_W += force_W;
  t.moment_B += moment_B;
  t.supplied += force_W.dot(rigid.v_WB_W) + moment_B.dot(rigid.w_WB_B);
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

void reset_forces(const SystemModel& model, const SystemState& state,
                  SystemTerms& terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    BodyTerms& t = terms.bodies[b];
    t.supplied = t.dissipated = 0.0;
    t.force_W.setZero();
    if (body.has_rigid_motion()) {
      t.force_W = body.mass * model.gravity_W;
      t.supplied += t.force_W.dot(state.bodies[b].v_WB_W);
    }
    t.moment_B.setZero();
    t.modal_force.setZero();
    terms.products[b].force.setZero();
    if (body.clamped && body.modes > 0) {
      add_gravity_on_modes(model, body, state, t, terms.products[b]);
    }
    if (body.modes > 0) {
      const ConstModes etadot = modes_of(body, state.etadot);
      t.dissipated += (body.damping.array() * etadot.array().square()).sum() +
                      find_maxwell_loss(body, state.maxwell);
    }
  }
  reset_full_forces(model, state, terms);
}

// Of all forces but loads and gravity, whose power is known already. With the
// velocities of these forces, so that powers of a coupler and of the bodies
// that it joins cancel at states that are not solutions either.
void set_received(const SystemModel& model, const SystemState& state,
                  SystemTerms& terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    BodyTerms& t = terms.bodies[b];
    if (body.full >= 0) {
      const auto f = static_cast<std::size_t>(body.full);
      const ConstNodes udot = nodes_of(model.full_bodies[f], state.udot_H);
      t.received = terms.full[f].force.cwiseProduct(udot).sum() + t.dissipated -
                   t.supplied;
      continue;
    }
    t.received = t.modal_force.dot(modes_of(body, state.etadot)) - t.supplied;
    if (!body.has_rigid_motion()) continue;
    const BodyState& rigid = state.bodies[b];
    t.received += t.force_W.dot(rigid.v_WB_W) + t.moment_B.dot(rigid.w_WB_B);
  }
}

}  // namespace

void clear_forces(SystemTerms& terms) {
  for (BodyTerms& body : terms.bodies) {
    body.force_W.setZero();
    body.moment_B.setZero();
    body.modal_force.setZero();
    body.bias_r.setZero();
    body.bias_e.setZero();
  }
  for (FullTerms& full : terms.full) {
    full.force.setZero();
    full.internal.setZero();
  }
}

SystemTerms make_terms(const SystemModel& model) {
  SystemTerms terms;
  for (const BodyModel& body : model.bodies) {
    const int m = body.modes;
    BodyTerms t;
    t.R_WB.setIdentity();
    t.J = body.J0;
    t.bias_r.setZero();
    t.bias_e = VectorX::Zero(m);
    t.force_W.setZero();
    t.moment_B.setZero();
    t.modal_force = VectorX::Zero(m);
    if (has_dense_modes(body)) {
      t.stiffness = MatrixX::Zero(m, m);
    }
    const auto padded =
        static_cast<Eigen::Index>(kernels::pad(static_cast<std::size_t>(m)));
    t.by_mode.setZero(padded, 12);
    terms.bodies.push_back(std::move(t));
    terms.products.push_back(
        make_product_terms(model, BodyIndex(terms.products.size())));
  }
  for (const FullModel& full : model.full_bodies) {
    const Eigen::Index nodes = full.mesh->node_count();
    FullTerms t;
    t.solver = full.mesh->make_solver();
    t.internal = t.force = t.scratch = Matrix3X::Zero(3, nodes);
    t.modal_rate = VectorX::Zero(full.damping.size());
    terms.full.push_back(std::move(t));
  }
  terms.attachments.resize(model.attachments.size());
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    if (model.attachments[i].nodal) {
      terms.attachments[i].nodal = static_cast<int>(terms.nodal_frames.size());
      terms.nodal_frames.emplace_back();
    }
    if (!model.attachments[i].second) continue;
    terms.attachments[i].Phi_B = model.attachments[i].Phi_B;
    terms.attachments[i].Psi_B = model.attachments[i].Psi_B;
    terms.attachments[i].wrench_B.setZero();
  }
  terms.couplers.resize(model.couplers.size());
  for (std::size_t c = 0; c < model.couplers.size(); ++c) {
    if (!joints::is_ideal(model.couplers[c].law)) continue;
    terms.couplers[c].ideal = static_cast<int>(terms.constraints.size());
    terms.constraints.emplace_back();
  }
  terms.transmissions = make_transmission_terms(model);
  terms.pairs = make_pair_terms(model);
  return terms;
}

void calc_inertia_terms(const SystemModel& model, const SystemState& state,
                        SystemTerms& terms) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const Vector3& w = state.bodies[b].w_WB_B;
    BodyTerms& t = terms.bodies[b];
    t.R_WB = state.bodies[b].quat_WB.toRotationMatrix();
    if (body.modes > 0) set_oscillator_bias(body, state, t);
    if (body.modes > 0 && !body.clamped && is_coupled(body.fidelity)) {
      set_coupled_terms(body, state, w, t);
      continue;
    }
    t.bias_r = w.cross(body.J0 * w);
    if (body.fidelity == Fidelity::one_way && !body.clamped) {
      add_centrifugal_bias(body, w, t);
    }
  }
  calc_full_terms(model, state, terms);
}

void calc_forces(const SystemModel& model, const SystemState& state, Side side,
                 SystemTerms& terms, WrenchSource source) {
  reset_forces(model, state, terms);
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& a = model.attachments[i];
    const Matrix3& R_WB =
        terms.bodies[a.body == kWorld ? 0 : static_cast<std::size_t>(a.body)]
            .R_WB;
    AttachmentMotion& motion = terms.attachments[i];
    if (a.nodal) {
      calc_nodal_attachment(model, a, state,
                            terms.nodal_frames[index(motion.nodal)], motion);
    } else {
      calc_attachment_motion(model, a, state, R_WB, motion);
    }
  }
  apply_couplers(model, state, now_of(state, side), source, terms);
  apply_pairs(model, state, now_of(state, side), terms);
  for (const Load& load : model.loads) {
    apply_load(model, state, load, side, terms);
  }
  for (const BodyLoad& load : model.body_loads) {
    apply_body_load(model, state, load, side, terms);
  }
  add_product_forces(model, state, terms);
  set_received(model, state, terms);
}

void calc_terms(const SystemModel& model, const SystemState& state, Side side,
                SystemTerms& terms, WrenchSource source) {
  calc_inertia_terms(model, state, terms);
  calc_forces(model, state, side, terms, source);
}

void solve_accelerations(const SystemModel& model, const SystemTerms& terms,
                         VectorX& accelerations) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const BodyTerms& t = terms.bodies[b];
    auto etaddot = mode_rows(body, accelerations);
    etaddot = t.modal_force - t.bias_e;
    if (!body.has_rigid_motion()) {
      accelerations.segment<6>(body.row).setZero();
      continue;
    }
    translation_rows(body, accelerations) = t.force_W / body.mass;
    Matrix3 schur = t.J;
    Vector3 right = t.moment_B - t.bias_r;
    for (int k = 0; k < body.modes; ++k) {
      const Vector3 H = t.H().col(k);
      schur -= H * H.transpose();
      right -= H * etaddot[k];
    }
    const Vector3 dw = schur.inverse() * right;
    rotation_rows(body, accelerations) = dw;
    for (int k = 0; k < body.modes; ++k) etaddot[k] -= t.H().col(k).dot(dw);
  }
  solve_full_accelerations(model, terms, accelerations);
}

void calc_residual(const SystemModel& model, const VectorX& acceleration,
                   SystemTerms& terms, VectorX& residual) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const BodyModel& body = model.bodies[b];
    const BodyTerms& t = terms.bodies[b];
    double* r = residual.data() + body.row;
    Eigen::Map<Vector3> translation(r);
    Eigen::Map<Vector3> rotation(r + 3);
    translation.setZero();
    rotation.setZero();
    const Vector3 dw = rotation_rows(body, acceleration);
    if (body.has_rigid_motion()) {
      translation =
          body.mass * translation_rows(body, acceleration) - t.force_W;
      rotation = t.J * dw + t.bias_r - t.moment_B;
    }
    const auto etaddot = mode_rows(body, acceleration);
    const auto H = t.by_mode.middleCols<3>(6).topRows(body.modes);
    for (int i = 0; i < 3; ++i) rotation[i] += H.col(i).dot(etaddot);
    mode_rows(body, residual) = etaddot + t.bias_e - t.modal_force +
                                H.col(0) * dw[0] + H.col(1) * dw[1] +
                                H.col(2) * dw[2];
    if (body.clamped) rotation.setZero();
  }
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    const FullModel& full = model.full_bodies[f];
    calc_full_residual(full, nodal_rows(model, full, acceleration),
                       terms.full[f], nodal_rows(model, full, residual));
  }
}

void add_geometric_stiffness(const SystemModel& model, std::size_t body,
                             const SystemTerms& terms,
                             Eigen::Ref<MatrixX> stiffness) {
  for (std::size_t i = 0; i < model.attachments.size(); ++i) {
    const Attachment& attachment = model.attachments[i];
    if (!attachment.second || attachment.body != static_cast<int>(body)) {
      continue;
    }
    const Vector6& wrench = terms.attachments[i].wrench_B;
    flexbody::add_contraction(*attachment.second, wrench.head<3>(),
                              wrench.tail<3>(), -1.0, stiffness);
  }
  if (terms.products[body].force.size() == 0) return;
  flexbody::add_product_stiffness(paired_of(model.bodies[body]),
                                  terms.products[body].force.data(), -1.0,
                                  stiffness);
}

}  // namespace limber::dynamics
