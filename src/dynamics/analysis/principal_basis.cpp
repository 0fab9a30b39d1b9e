// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/principal_basis.hpp"

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/qr.hpp"
#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/dynamics/newton/force_balance.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;

/// Columns orthogonal to Q's of full rank.
MatrixX find_complement(const MatrixX& Q) {
  if (Q.cols() == 0) return MatrixX::Identity(Q.rows(), Q.rows());
  return dense::find_q(Q, Q.rows()).rightCols(Q.rows() - Q.cols());
}

/// Null space of the rows, normalised to unit length.
MatrixX find_null_space(MatrixX rows) {
  constexpr double kDependent = 1e-10;
  rows.rowwise().normalize();
  const Index n = rows.cols();
  if (rows.rows() == 0) return MatrixX::Identity(n, n);
  const auto [Q, rank] = dense::find_pivoted_q(rows.transpose(), kDependent);
  return Q.rightCols(n - rank);
}

/// Translations of all bodies together, if nothing ties them to the world.
MatrixX find_free_translations(const SystemModel& model,
                               const SmallMotion& motion) {
  std::size_t free = 0;
  for (const auto& group : find_free_groups(model)) free += group.size();
  MatrixX drift(motion.size(), 0);
  if (free < model.bodies.size()) return drift;
  drift = MatrixX::Zero(motion.size(), 3);
  for (const Index p : motion.places) {
    if (p >= 0) drift.block<3, 3>(p, 0).setIdentity();
  }
  return drift;
}

}  // namespace

PrincipalBasis find_principal_basis(const SystemModel& model,
                                    const SmallMotion& motion) {
  constexpr double kNothing = 1e-9;
  constexpr double kSafety = 10.0;  // of round-off
  const Index n = motion.size();
  const auto L = dense::find_cholesky(motion.M);  // M = L L'
  LIMBER_EXPECT(L.has_value());
  const MatrixX to_x =
      dense::solve_lower_transposed(*L, MatrixX::Identity(n, n));
  MatrixX drift = find_free_translations(model, motion);
  if (drift.cols() > 0) {  // separate: momentum is conserved
    drift = dense::find_q(L->transpose() * drift, drift.cols());
  }
  const MatrixX holds = motion.find_holds() * to_x;
  MatrixX rows(holds.rows() + drift.cols(), n);
  rows.topRows(holds.rows()) = holds;
  rows.bottomRows(drift.cols()) = drift.transpose();
  const MatrixX open = find_null_space(rows);
  MatrixX free = drift;
  if (open.cols() > 0) {
    const MatrixX rest = to_x.transpose() * motion.rest * to_x;
    const MatrixX noise = to_x.transpose() * motion.noise * to_x * open;
    const auto svd = dense::find_right_singular_form(rest * open);
    const double least = kNothing * rest.norm() + kSafety * noise.norm();
    const Index resisted = (svd.values.array() > least).count();
    const Index loose = open.cols() - resisted;
    free.conservativeResize(n, drift.cols() + loose);
    free.rightCols(loose) = open * svd.V.rightCols(loose);
  }
  if (free.cols() == n) return {to_x * free, n, drift.cols()};
  const MatrixX other = to_x * find_complement(free);
  const MatrixX S = motion.project_stiffness(other);
  const auto eigen = dense::find_eigenpairs(MatrixX(0.5 * (S + S.transpose())));
  PrincipalBasis basis{MatrixX(n, n), free.cols(), drift.cols()};
  basis.Q << to_x * free, other * eigen.vectors;
  return basis;
}

bool is_conservative(const SmallMotion& motion, const PrincipalBasis& basis) {
  constexpr double kSame = 1e-12;
  const MatrixX S = motion.project_stiffness(basis.Q);
  return motion.relaxations.empty() && motion.D.isZero(0.0) &&
         (S - S.transpose()).norm() <= kSame * S.norm();
}

}  // namespace limber::dynamics
