// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/equations/full_energy.hpp"

namespace limber::dynamics {
namespace {

void add_body(const SystemModel& model, std::size_t f, const SystemState& state,
              FullTerms& t, EnergyBalance& balance) {
  const FullModel& full = model.full_bodies[f];
  const ConstNodes udot = nodes_of(full, state.udot_H);
  t.solver->multiply_mass(udot, t.scratch);  // momenta
  const double kinetic = 0.5 * t.scratch.cwiseProduct(udot).sum();
  if (model.bodies[static_cast<std::size_t>(full.body)].clamped) {
    balance.kinetic_modal += kinetic;
    return;
  }
  MeanFrame frame;
  calc_mean_frame(model, full, state, frame);
  const Matrix3X& x = full.mesh->x_B;
  const ConstNodes u = nodes_of(full, state.u_H);
  const double mass = full.mesh->node_mass.sum();
  const Vector3 momentum = t.scratch.rowwise().sum();
  const Vector3 center = (x + u) * full.mesh->node_mass / mass;
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
  const Pose& X_WH = state.X_WH[f];
  const Vector3 momentum_W = X_WH.R * momentum;
  balance.linear_momentum += momentum_W;
  balance.angular_momentum += (X_WH * center).cross(momentum_W) + X_WH.R * spin;
}

}  // namespace

void add_full_energy(const SystemModel& model, const SystemState& state,
                     SystemTerms& terms, EnergyBalance& balance) {
  for (std::size_t f = 0; f < model.full_bodies.size(); ++f) {
    add_body(model, f, state, terms.full[f], balance);
  }
}

}  // namespace limber::dynamics
