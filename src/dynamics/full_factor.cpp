// SPDX-License-Identifier: BSD-3-Clause
#include "dynamics/full_factor.hpp"

#include <Eigen/LU>
#include <cmath>

#include "dynamics/full_terms.hpp"

namespace limber::dynamics {
namespace {

// Turns three rows at a time.
void turn_nodes(const Matrix3& R, Eigen::Ref<VectorX> x) {
  for (Eigen::Index i = 0; i < x.size(); i += 3) {
    const Vector3 turned = R * x.segment<3>(i);
    x.segment<3>(i) = turned;
  }
}

}  // namespace

bool FullFactor::update(const SystemModel& model, std::size_t f,
                        const SystemState& state, SystemTerms& terms,
                        const Coefficients& c, bool renews) {
  constexpr double kSame = 1e-9;
  const FullModel& full = model.full_bodies[f];
  MeanFrame frame;
  calc_mean_frame(model, full, state, frame);
  R_HB_ = frame.R_HB;
  const double change = std::abs(c.acceleration - acceleration_);
  if (!renews && change <= kSame * c.acceleration) return false;
  acceleration_ = 0.0;
  Matrix3X u_B(3, full.mesh->node_count());
  calc_deformation(full, frame, nodes_of(full, state.u_H), u_B);
  flexbody::FullBodySolver& solver = *terms.full[f].solver;
  name_failures(model, full, state.t,
                [&] { solver.factor(u_B, c.acceleration); });
  acceleration_ = c.acceleration;
  add_damping(full, solver, c.velocity);
  return true;
}

void FullFactor::add_damping(const FullModel& full,
                             const flexbody::FullBodySolver& solver,
                             double velocity) {
  if (full.damping.size() == 0) return;
  V_ = full.damped_modes;
  solver.solve(V_);
  const MatrixX UtV = full.damped_modes.transpose() * V_;
  const MatrixX C = (velocity * full.damping).asDiagonal();
  const MatrixX small = MatrixX::Identity(C.rows(), C.cols()) + C * UtV;
  V_ *= small.partialPivLu().solve(C).eval();
}

void FullFactor::solve_columns(const FullModel& full,
                               const flexbody::FullBodySolver& solver,
                               Eigen::Ref<MatrixX> x_B) const {
  solver.solve(x_B);
  if (full.damping.size() == 0) return;
  const MatrixX rates = full.damped_modes.transpose() * x_B;
  x_B.noalias() -= V_ * rates;
}

void FullFactor::solve(const FullModel& full,
                       const flexbody::FullBodySolver& solver,
                       Eigen::Ref<VectorX> x_H) const {
  turn_nodes(R_HB_.transpose(), x_H);
  solve_columns(full, solver, x_H);
  turn_nodes(R_HB_, x_H);
}

}  // namespace limber::dynamics
