// SPDX-License-Identifier: BSD-3-Clause
#include "flexbody/reduced_basis.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "common/errors.hpp"
#include "flexbody/multiply_mass.hpp"

namespace limber::flexbody {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Signs are otherwise arbitrary: the largest entry is made positive, so that
/// two runs agree.
void fix_signs(MatrixX& Phi) {
  for (Eigen::Index k = 0; k < Phi.cols(); ++k) {
    Eigen::Index largest = 0;
    Phi.col(k).cwiseAbs().maxCoeff(&largest);
    if (Phi(largest, k) < 0.0) Phi.col(k) *= -1.0;
  }
}

}  // namespace

MatrixX orthonormalise(const MatrixX& vectors, const SparseMatrix& M_s,
                       const MatrixX& R, double drop_tolerance) {
  LIMBER_EXPECT(vectors.rows() == 3 * M_s.cols());
  LIMBER_EXPECT(R.rows() == vectors.rows());
  // Rigid modes lead, so that one Gram-Schmidt loop also projects them out.
  const Eigen::Index rigid = R.cols();
  MatrixX Q(vectors.rows(), rigid + vectors.cols());
  MatrixX MQ(Q.rows(), Q.cols());
  Q.leftCols(rigid) = R;
  for (Eigen::Index k = 0; k < rigid; ++k)
    MQ.col(k) = multiply_mass(M_s, R.col(k));
  Eigen::Index kept = rigid;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k) {
    VectorX x = vectors.col(k);
    const double before = std::sqrt(x.dot(multiply_mass(M_s, x).col(0)));
    if (!std::isfinite(before))
      throw NumericalError(
          fmt::format("reduced basis: vector {} is not finite", k + 1));
    if (before == 0.0) continue;
    x /= before;
    double norm = 1.0;
    // Twice is enough (Giraud, Langou, Rozloznik, 2005), normalised between,
    // so that what is left of a nearly dependent vector is clean.
    for (int pass = 0; pass < 2 && norm > drop_tolerance; ++pass) {
      x -= Q.leftCols(kept) * (MQ.leftCols(kept).transpose() * x);
      const double left = std::sqrt(x.dot(multiply_mass(M_s, x).col(0)));
      norm *= left;
      if (left > 0.0) x /= left;
    }
    if (norm <= drop_tolerance) continue;
    Q.col(kept) = x;
    MQ.col(kept) = multiply_mass(M_s, x);
    ++kept;
  }
  return Q.middleCols(rigid, kept - rigid);
}

ReducedBasis make_reduced_basis(const MatrixX& vectors, const SparseMatrix& M_s,
                                const SparseMatrix& K_lower, const MatrixX& R,
                                double drop_tolerance) {
  LIMBER_EXPECT(K_lower.cols() == vectors.rows());
  const MatrixX Q = orthonormalise(vectors, M_s, R, drop_tolerance);
  if (Q.cols() == 0) return {VectorX(0), Q};
  const MatrixX KQ = K_lower.selfadjointView<Eigen::Lower>() * Q;
  const MatrixX K = Q.transpose() * KQ;
  const Eigen::SelfAdjointEigenSolver<MatrixX> solver(0.5 *
                                                      (K + K.transpose()));
  ReducedBasis basis{solver.eigenvalues(), Q * solver.eigenvectors()};
  fix_signs(basis.Phi);
  return basis;
}

}  // namespace limber::flexbody
