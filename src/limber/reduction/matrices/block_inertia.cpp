// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/matrices/block_inertia.hpp"

#include <array>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::flexbody {
namespace {

using fem::SparseMatrix;
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Part of M whose rows are translations (0) or rotations (3) from `first` and
/// whose columns those from `second`, 3N x 3N.
SparseMatrix take_part(const MatrixSystem& system, int first, int second) {
  Triplets entries;
  for (Eigen::Index j = 0; j < system.M.outerSize(); ++j) {
    const fem::MatrixRow& right = system.rows[static_cast<std::size_t>(j)];
    if (right.node < 0 || right.component < 0 ||
        right.component / 3 != second / 3)
      continue;
    for (SparseMatrix::InnerIterator it(system.M, j); it; ++it) {
      const fem::MatrixRow& left =
          system.rows[static_cast<std::size_t>(it.row())];
      if (left.node < 0 || left.component < 0 ||
          left.component / 3 != first / 3)
        continue;
      entries.emplace_back(3 * left.node + left.component % 3,
                           3 * right.node + right.component % 3, it.value());
    }
  }
  const auto count = 3 * static_cast<Eigen::Index>(system.tags.size());
  SparseMatrix part(count, count);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

/// (tr(R)/2 I - R)^T of each block R.
SparseMatrix find_second_moments(const SparseMatrix& rr) {
  Triplets entries;
  for (Eigen::Index j = 0; j < rr.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(rr, j); it; ++it) {
      const Eigen::Index row = it.row() / 3 * 3;
      const Eigen::Index column = j / 3 * 3;
      entries.emplace_back(row + j % 3, column + it.row() % 3, -it.value());
      if (it.row() % 3 != j % 3) continue;
      for (Eigen::Index c = 0; c < 3; ++c)
        entries.emplace_back(row + c, column + c, 0.5 * it.value());
    }
  SparseMatrix D(rr.rows(), rr.cols());
  D.setFromTriplets(entries.begin(), entries.end());
  return D;
}

/// Sum of all 3 x 3 blocks.
Matrix3 sum_blocks(const SparseMatrix& A) {
  Matrix3 sum = Matrix3::Zero();
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it)
      sum(it.row() % 3, j % 3) += it.value();
  return sum;
}

/// Vectors 3 x N of a column of 3N rows.
Matrix3X by_node(const VectorX& column) {
  return column.reshaped(3, column.size() / 3);
}

/// hat(v_n) of each node, side by side: 3 x 3N.
Matrix3X skew_each(const Matrix3X& v) {
  Matrix3X result(3, 3 * v.cols());
  for (Eigen::Index n = 0; n < v.cols(); ++n)
    result.middleCols<3>(3 * n) = skew(Vector3(v.col(n)));
  return result;
}

/// Translations (0) or rotations (3) of the nodes of one column of rows.
VectorX take_nodal(const MatrixSystem& system, const VectorX& column,
                   int first) {
  VectorX nodal =
      VectorX::Zero(3 * static_cast<Eigen::Index>(system.tags.size()));
  for (Eigen::Index i = 0; i < column.size(); ++i) {
    const fem::MatrixRow& row = system.rows[static_cast<std::size_t>(i)];
    if (row.node >= 0 && row.component >= first && row.component < first + 3)
      nodal[3 * row.node + row.component - first] = column[i];
  }
  return nodal;
}

/// Of one mode: fields at the nodes and what M makes of them.
struct ModeFields {
  Matrix3X u;      ///< translations
  Matrix3X theta;  ///< rotations
  Matrix3X Wu;     ///< M_tt u
  Matrix3X Wt;     ///< M_tr theta
  Matrix3X hat;    ///< hat(theta), 3 x 3N
  MatrixX Dhat;    ///< D hat(theta)^T, 3N x 3
};

ModeFields find_fields(const MatrixSystem& system, const MassBlocks& blocks,
                       const VectorX& phi) {
  const VectorX u = take_nodal(system, phi, 0);
  const VectorX theta = take_nodal(system, phi, 3);
  ModeFields fields;
  fields.u = by_node(u);
  fields.theta = by_node(theta);
  fields.Wu = by_node(blocks.tt * u);
  fields.Wt = by_node(blocks.tr * theta);
  fields.hat = skew_each(fields.theta);
  fields.Dhat = blocks.D * fields.hat.transpose();
  return fields;
}

/// int u_k u_l^T dm
Matrix3 calc_S2(const ModeFields& k, const ModeFields& l) {
  return 0.5 * (k.u * l.Wu.transpose() + k.Wu * l.u.transpose()) +
         k.u * l.Wt.transpose() + k.Wt * l.u.transpose() + k.hat * l.Dhat;
}

/// Y = M X_r by nodes.
struct MassMoments {
  std::array<Matrix3X, 3> t;  ///< translation rows for each rotation
  std::array<Matrix3X, 3> r;  ///< rotation rows
};

MassMoments find_mass_moments(const MatrixSystem& system, const MatrixX& Y) {
  MassMoments moments;
  for (std::size_t a = 0; a < 3; ++a) {
    const VectorX column = Y.col(static_cast<Eigen::Index>(a));
    moments.t[a] = by_node(take_nodal(system, column, 0));
    moments.r[a] = by_node(take_nodal(system, column, 3));
  }
  return moments;
}

/// J1 = A + A^T, A_ab = int (e_a x y) . (e_b x u) dm
Matrix3 calc_J1(const MassMoments& Y, const ModeFields& mode) {
  Matrix3 A = Matrix3::Zero();
  for (Eigen::Index n = 0; n < mode.u.cols(); ++n) {
    Matrix3 Yt;
    Matrix3 Q;
    for (Eigen::Index a = 0; a < 3; ++a) {
      Yt.col(a) = Y.t[static_cast<std::size_t>(a)].col(n);
      Q.col(a) = Y.r[static_cast<std::size_t>(a)].col(n);
    }
    // y_t(a) . (e_b x u) = (u x y_t(a))_b
    A += (skew(Vector3(mode.u.col(n))) * Yt).transpose();
    const Matrix3 E = 0.5 * Q.trace() * Matrix3::Identity() - Q;
    const Matrix3 F = E * skew(Vector3(mode.theta.col(n))).transpose();
    A += F.trace() * Matrix3::Identity() - F.transpose();
  }
  return A + A.transpose();
}

}  // namespace

MassBlocks::MassBlocks(const MatrixSystem& system)
    : tt(take_part(system, 0, 0)),
      tr(take_part(system, 0, 3)),
      D(find_second_moments(take_part(system, 3, 3))) {}

Matrix3 read_second_moments(const MatrixSystem& system,
                            const MassBlocks& blocks, const Vector3& center) {
  const Matrix3X x = system.x.colwise() - center;
  const Matrix3X Wx = by_node(blocks.tt * VectorX(x.reshaped()));
  // s_i = sum_j int N_i d_j dm, of M_tr,ij = -int N_i hat(d_j) dm
  Matrix3X s = Matrix3X::Zero(3, x.cols());
  for (Eigen::Index j = 0; j < blocks.tr.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(blocks.tr, j); it; ++it) {
      const auto a = static_cast<int>(it.row() % 3);
      const auto b = static_cast<int>(j % 3);
      if (a == b) continue;
      const int c = 3 - a - b;
      const double sign = (b - a + 3) % 3 == 1 ? 0.5 : -0.5;
      // hat(d)_ab = -d_c for (a, b, c) cyclic, so M_tr,ab = +N d_c
      s(c, it.row() / 3) += sign * it.value();
    }
  const Matrix3 half = x * Wx.transpose();
  const Matrix3 mixed = x * s.transpose();
  return 0.5 * (half + half.transpose()) + mixed + mixed.transpose() +
         sum_blocks(blocks.D);
}

double calc_block_defect(const MatrixSystem& system, const MassBlocks& blocks,
                         const RigidInertia& inertia) {
  const Matrix3 S0 = read_second_moments(system, blocks, inertia.center);
  const Matrix3 J = S0.trace() * Matrix3::Identity() - S0;
  return (J - inertia.J0).cwiseAbs().maxCoeff() /
         inertia.J0.cwiseAbs().maxCoeff();
}

InertiaShapeIntegrals calc_block_integrals(const MatrixSystem& system,
                                           const MassBlocks& blocks,
                                           const MatrixX& X,
                                           const MatrixX& Phi) {
  LIMBER_EXPECT(X.rows() == system.row_count() && X.cols() == 6);
  LIMBER_EXPECT(Phi.rows() == system.row_count());
  const auto m = static_cast<std::size_t>(Phi.cols());
  const MatrixX MX = fem::multiply_mass(system.M, X);
  const MatrixX moments = MX.transpose() * Phi;  // 6 x m
  const Matrix3 J = X.rightCols<3>().transpose() * MX.rightCols<3>();
  const Matrix3 J0 = 0.5 * (J + J.transpose());
  const MassMoments Y = find_mass_moments(system, MX.rightCols<3>());
  std::vector<ModeFields> modes;
  modes.reserve(m);
  for (std::size_t k = 0; k < m; ++k)
    modes.push_back(
        find_fields(system, blocks, Phi.col(static_cast<Eigen::Index>(k))));
  InertiaShapeIntegrals result;
  result.S0 = 0.5 * J0.trace() * Matrix3::Identity() - J0;
  result.P = moments.topRows<3>();
  for (std::size_t k = 0; k < m; ++k) {
    const Matrix3 J1 = calc_J1(Y, modes[k]);
    const Vector3 h = moments.block<3, 1>(3, static_cast<Eigen::Index>(k));
    // x u^T - u x^T = -hat(x x u)
    result.S1.push_back(0.5 * (0.5 * J1.trace() * Matrix3::Identity() - J1) -
                        0.5 * skew(h));
    for (std::size_t l = 0; l < m; ++l)
      result.S2.push_back(calc_S2(modes[k], modes[l]));
  }
  return result;
}

SparseMatrix find_scalar_mass(const MassBlocks& blocks) {
  Triplets entries;
  for (Eigen::Index j = 0; j < blocks.tt.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(blocks.tt, j); it; ++it)
      if (it.row() % 3 == j % 3)
        entries.emplace_back(it.row() / 3, j / 3, it.value() / 3.0);
  SparseMatrix mass(blocks.tt.rows() / 3, blocks.tt.cols() / 3);
  mass.setFromTriplets(entries.begin(), entries.end());
  return mass;
}

}  // namespace limber::flexbody
