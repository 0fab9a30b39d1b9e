// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/index.hpp"
#include "limber/dynamics/bodies/body_increment.hpp"
#include "limber/dynamics/newton/residual_derivative.hpp"
#include "limber/dynamics/system/body_model.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/flexbody/model/mode_products.hpp"

namespace limber::dynamics {

void ResidualDerivative::change_load(const Load& load, const VectorX& x,
                                     VectorX& r) const {
  const Attachment& a = model_.attachments[index(load.where)];
  if (a.body == kWorld || a.nodal) return;
  const double factor = evaluate(load.function, now_of(*state_, Side::left));
  if (factor == 0.0) return;
  const auto b = index(a.body);
  const BodyModel& body = model_.bodies[b];
  const Matrix3& R_WB = terms_->bodies[b].R_WB;
  const BodyIncrement d(body, x);
  const Vector3 force = factor * load.force;
  const Vector3 moment = factor * load.moment;
  if (is_coupled(body.fidelity)) {
    if (load.in_world) {
      change_wrench(load.where, force, moment, Vector3::Zero(), Vector3::Zero(),
                    x, r);
    } else {
      change_wrench(load.where, R_WB * force, R_WB * moment,
                    R_WB * d.theta.cross(force), R_WB * d.theta.cross(moment),
                    x, r);
    }
    return;
  }
  if (!body.has_rigid_motion()) return;
  if (!load.in_world) {
    r.segment<3>(body.row) -= R_WB * d.theta.cross(force);
    return;
  }
  const Vector3 d_force_B = -d.theta.cross(R_WB.transpose() * force);
  const Vector3 d_moment_B = -d.theta.cross(R_WB.transpose() * moment);
  r.segment<3>(body.row + 3) -= a.p_BF.cross(d_force_B) + d_moment_B;
  r.segment(body.row + 6, body.modes) -=
      a.Phi_B.leftCols(body.modes).transpose() * d_force_B +
      a.Psi_B.leftCols(body.modes).transpose() * d_moment_B;
}

void ResidualDerivative::change_body_load(const BodyLoad& load,
                                          const VectorX& x, VectorX& r) const {
  const auto b = index(load.body);
  const BodyModel& body = model_.bodies[b];
  if (!body.has_rigid_motion()) return;
  const flexbody::NodalLoad& history = load.history;
  const Eigen::Index i = find_interval(history.times, state_->t, Side::left);
  if (i < 0) return;
  const BodyIncrement d(body, x);
  const Vector3 force = history.force.col(i);
  r.segment<3>(body.row) -= terms_->bodies[b].R_WB * d.theta.cross(force);
  if (!is_coupled(body.fidelity)) return;
  const Eigen::Index first = i * count_coordinates(body);
  const double* eta = state_->eta.data() + body.offset;
  Vector3 moment = Vector3::Zero();
  for (int k = 0; k < body.modes; ++k) {
    moment += history.moment_by_mode.col(first + k) * d.eta[k];
  }
  flexbody::for_each_product(paired_of(body), [&](Eigen::Index pair, int k,
                                                  int l, bool is_square) {
    const double change =
        is_square ? eta[k] * d.eta[k] : eta[k] * d.eta[l] + eta[l] * d.eta[k];
    moment += history.moment_by_mode.col(first + body.modes + pair) * change;
  });
  r.segment<3>(body.row + 3) -= moment;
}

}  // namespace limber::dynamics
