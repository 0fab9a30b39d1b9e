// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/bodies/nodal_factor.hpp"

#include <cmath>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/index.hpp"
#include "limber/common/rotation.hpp"
#include "limber/dynamics/bodies/nodal_body.hpp"
#include "limber/dynamics/system/unknowns.hpp"
#include "limber/dynamics/terms/attachment_jacobian.hpp"

namespace limber::dynamics {
namespace {

std::size_t index_of_full(const SystemModel& model, std::size_t body) {
  return index(model.bodies[body].full);
}

// Rotates three rows at a time.
void rotate_nodes(const Matrix3& R, Eigen::Ref<VectorX> x) {
  for (Eigen::Index i = 0; i < x.size(); i += 3) {
    const Vector3 turned = R * x.segment<3>(i);
    x.segment<3>(i) = turned;
  }
}

// Ratio of K to M by the energy of random small displacements. About a third of
// the largest eigenvalue.
double measure_stiffness(const FullModel& full,
                         flexbody::FullBodySolver& solver) {
  constexpr double kSmall = 1e-7;
  const Matrix3X& x = full.mesh->x_B;
  Matrix3X u(3, x.cols());
  const double size =
      (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double number = static_cast<double>(i);
    u(i) = kSmall * size * std::sin(1e4 * std::sin(number + 1.0));
  }
  Matrix3X scratch(3, x.cols());
  const double energy = solver.calc_internal_force(u, scratch);
  solver.multiply_mass(u, scratch);
  return 2.0 * energy / scratch.cwiseProduct(u).sum();
}

// Translations and rotations of the deformed body: 3N x 6.
MatrixX make_rigid_fields(const Matrix3X& b_B) {
  MatrixX R(b_B.size(), 6);
  for (Eigen::Index i = 0; i < b_B.cols(); ++i) {
    R.block<3, 3>(3 * i, 0).setIdentity();
    R.block<3, 3>(3 * i, 3) = -skew(b_B.col(i));
  }
  return R;
}

}  // namespace

bool NodalFactor::update(const SystemModel& model, std::size_t b,
                         const SystemState& state, SystemTerms& terms,
                         const Matrix3& /*T*/, const TangentCoefficients& c,
                         bool renews) {
  constexpr double kSame = 1e-9;
  const std::size_t f = index_of_full(model, b);
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
  const bool is_free =
      !model.bodies[static_cast<std::size_t>(full.body)].clamped;
  const double shift = name_failures(model.bodies[b], state.t, [&] {
    return is_free ? factor_free(full, solver, u_B, c.acceleration)
                   : (solver.factor(u_B, c.acceleration), c.acceleration);
  });
  acceleration_ = c.acceleration;
  rigid_.resize(0, 0);
  if (shift > c.acceleration) set_rigid_motion(full, solver, u_B);
  add_damping(full, solver, c.velocity);
  return true;
}

// The tangent of an unclamped body has no stiffness against rigid motion, and a
// negative one under stress.
double NodalFactor::factor_free(const FullModel& full,
                                flexbody::FullBodySolver& solver,
                                const Matrix3X& u_B, double shift) {
  constexpr double kRegular = 1e-10;
  constexpr double kGrowth = 10.0;
  constexpr double kMost = 1.0;
  if (stiffness_ == 0.0) stiffness_ = measure_stiffness(full, solver);
  shift = std::max(shift, kRegular * stiffness_);
  for (;; shift *= kGrowth) {
    try {
      solver.factor(u_B, shift);
      return shift;
    } catch (const NumericalError&) {
      if (shift > kMost * stiffness_) throw;
    }
  }
}

void NodalFactor::set_rigid_motion(const FullModel& full,
                                   const flexbody::FullBodySolver& solver,
                                   const Matrix3X& u_B) {
  rigid_ = make_rigid_fields(full.mesh->x_B + u_B);
  rigid_momenta_.resize(rigid_.rows(), 6);
  const auto multiply_mass = [&] {
    for (int k = 0; k < 6; ++k) {
      const ConstNodes field(rigid_.col(k).data(), 3, u_B.cols());
      Nodes momenta(rigid_momenta_.col(k).data(), 3, u_B.cols());
      solver.multiply_mass(field, momenta);
    }
  };
  multiply_mass();
  const MatrixX inertia = rigid_.transpose() * rigid_momenta_;
  const auto L = dense::find_cholesky(inertia);
  LIMBER_EXPECT(L.has_value());
  dense::divide_by_lower_transposed(*L, rigid_);
  multiply_mass();
}

void NodalFactor::solve_undamped(const flexbody::FullBodySolver& solver,
                                 Eigen::Ref<MatrixX> x_B) const {
  if (rigid_.size() == 0) {
    solver.solve(x_B);
    return;
  }
  const MatrixX pushes = rigid_.transpose() * x_B;
  x_B.noalias() -= rigid_momenta_ * pushes;
  solver.solve(x_B);
  const MatrixX motion =
      pushes / acceleration_ - rigid_momenta_.transpose() * x_B;
  x_B.noalias() += rigid_ * motion;
}

void NodalFactor::add_damping(const FullModel& full,
                              const flexbody::FullBodySolver& solver,
                              double velocity) {
  if (full.damping.size() == 0) return;
  V_ = full.damped_modes;
  solve_undamped(solver, V_);
  const MatrixX UtV = full.damped_modes.transpose() * V_;
  const MatrixX C = (velocity * full.damping).asDiagonal();
  const MatrixX small = MatrixX::Identity(C.rows(), C.cols()) + C * UtV;
  V_ *= dense::solve(small, C);
}

void NodalFactor::solve_columns(const FullModel& full,
                                const flexbody::FullBodySolver& solver,
                                Eigen::Ref<MatrixX> x_B) const {
  solve_undamped(solver, x_B);
  if (full.damping.size() == 0) return;
  const MatrixX rates = full.damped_modes.transpose() * x_B;
  x_B.noalias() -= V_ * rates;
}

void NodalFactor::solve(const SystemModel& model, std::size_t b,
                        const SystemTerms& terms, VectorX& x) const {
  const std::size_t f = index_of_full(model, b);
  const FullModel& full = model.full_bodies[f];
  auto x_H = x.segment(first_node_row(model) + full.first, full.dofs());
  rotate_nodes(R_HB_.transpose(), x_H);
  solve_columns(full, *terms.full[f].solver, x_H);
  rotate_nodes(R_HB_, x_H);
}

LinkEnd NodalFactor::make_end(const SystemModel& model, std::size_t b) const {
  const FullModel& full = model.full_bodies[index_of_full(model, b)];
  return {.row = first_node_row(model) + full.first,
          .G = Matrix6X::Zero(6, full.dofs())};
}

void NodalFactor::renew_end(const SystemModel& model, std::size_t b,
                            const SystemTerms& terms, LinkEnd& end) const {
  const std::size_t f = index_of_full(model, b);
  const auto i = index(end.attachment);
  Matrix6X motion(6, end.G.cols());
  calc_nodal_jacobian(*model.attachments[i].nodal,
                      terms.nodal_frame(terms.attachments[i]),
                      R_HB_.transpose(), motion);
  for (Eigen::Index n = 0; n < motion.cols(); n += 3) {
    motion.middleCols<3>(n) = (motion.middleCols<3>(n) * R_HB_).eval();
  }
  MatrixX columns = motion.transpose();
  solve_columns(model.full_bodies[f], *terms.full[f].solver, columns);
  end.Zt_B = columns.transpose();
}

void NodalFactor::calc_rows(const SystemModel& model, std::size_t b,
                            const SystemState& state, const SystemTerms& terms,
                            const Matrix3& R_FW, LinkEnd& end) const {
  const auto i = index(end.attachment);
  const Matrix3& R_WH = state.X_WH[index_of_full(model, b)].R;
  calc_nodal_jacobian(*model.attachments[i].nodal,
                      terms.nodal_frame(terms.attachments[i]), R_FW * R_WH,
                      end.G);
}

void NodalFactor::rotate_answers(const SystemModel& model, std::size_t b,
                                 const SystemState& state, const Matrix3& R_FW,
                                 LinkEnd& end) const {
  const Matrix3 R_FB = R_FW * state.X_WH[index_of_full(model, b)].R * R_HB_;
  for (Eigen::Index i = 0; i < end.Zt.cols(); i += 3) {
    end.Zt.block<3, 3>(0, i) =
        R_FB * end.Zt_B.block<3, 3>(0, i) * R_HB_.transpose();
    end.Zt.block<3, 3>(3, i) =
        R_FB * end.Zt_B.block<3, 3>(3, i) * R_HB_.transpose();
  }
}

}  // namespace limber::dynamics
