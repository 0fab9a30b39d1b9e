// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/rigid_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "limber/fem/linalg/cholesky.hpp"

namespace limber::flexbody {
namespace {

bool is_placed(const fem::MatrixRow& row) {
  return row.node >= 0 && row.component >= 0;
}

/// Rows of unknown kind with stiffness, sorted; others of them stay zero.
std::vector<int> find_unknown(const MatrixSystem& system) {
  std::vector<int> unknown;
  for (int i = 0; i < system.row_count(); ++i)
    if (!is_placed(system.rows[static_cast<std::size_t>(i)]) &&
        !std::binary_search(system.null.begin(), system.null.end(), i))
      unknown.push_back(i);
  return unknown;
}

void follow_stiffness(const MatrixSystem& system, MatrixX& X) {
  const std::vector<int> unknown = find_unknown(system);
  if (unknown.empty()) return;
  const fem::SparseMatrix K_uu = fem::restrict_matrix(system.K, unknown);
  const fem::SparseMatrix lower = K_uu.triangularView<Eigen::Lower>();
  const MatrixX load = system.K * X;  // X_u is still zero
  try {
    const fem::SparseCholesky factor(lower, fem::order_nodes(lower), "K_uu");
    const MatrixX X_u = -factor.solve(load(unknown, Eigen::all));
    X(unknown, Eigen::all) = X_u;
  } catch (const NumericalError&) {
    throw InputError(fmt::format(
        "{}: {} rows have no known direction (the first is {}), and the "
        "stiffness does not determine how they move with the body; give their "
        "node and direction in the table of degrees of freedom",
        system.source, unknown.size(), system.name_row(unknown.front())));
  }
}

}  // namespace

MatrixX make_rigid_motions(const MatrixSystem& system) {
  MatrixX X = MatrixX::Zero(system.row_count(), 6);
  for (Eigen::Index i = 0; i < system.row_count(); ++i) {
    const fem::MatrixRow& row = system.rows[static_cast<std::size_t>(i)];
    if (!is_placed(row)) continue;
    if (row.component >= 3) {
      X(i, row.component) = 1.0;
      continue;
    }
    X(i, row.component) = 1.0;
    // (e_a x x)_c = -(hat(x))_ca
    X.block<1, 3>(i, 3) =
        -skew(Vector3(system.x.col(row.node))).row(row.component);
  }
  follow_stiffness(system, X);
  return X;
}

MatrixX move_origin(const MatrixX& X, const Vector3& point) {
  MatrixX moved = X;
  // e_a x (x - p) = e_a x x - e_a x p
  moved.rightCols<3>() += X.leftCols<3>() * skew(point);
  return moved;
}

RigidInertia calc_rigid_inertia(const MatrixSystem& system, const MatrixX& X) {
  const Matrix6 B = X.transpose() * fem::multiply_mass(system.M, X);
  RigidInertia inertia;
  const Matrix3 tt = B.topLeftCorner<3, 3>();
  const Matrix3 tr = B.topRightCorner<3, 3>();  // -m hat(c)
  inertia.mass = tt.trace() / 3.0;
  if (!(inertia.mass > 0.0))
    throw InputError(fmt::format(
        "{}: the mass matrix has no mass in translation ({:.3g} kg)",
        system.source, inertia.mass));
  inertia.center =
      Vector3(tr(1, 2) - tr(2, 1), tr(2, 0) - tr(0, 2), tr(0, 1) - tr(1, 0)) /
      (2.0 * inertia.mass);
  const Matrix3 moved = inertia.mass * skew(inertia.center);
  const double length = std::max(system.size().maxCoeff(), 1e-300);
  inertia.defect =
      std::max((tt - inertia.mass * Matrix3::Identity()).cwiseAbs().maxCoeff() /
                   inertia.mass,
               (tr + moved).cwiseAbs().maxCoeff() / (inertia.mass * length));
  const MatrixX X_c = move_origin(X, inertia.center).rightCols<3>();
  const Matrix3 J = X_c.transpose() * fem::multiply_mass(system.M, X_c);
  inertia.J0 = 0.5 * (J + J.transpose());
  return inertia;
}

}  // namespace limber::flexbody
