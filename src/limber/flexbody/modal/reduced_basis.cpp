// SPDX-License-Identifier: BSD-3-Clause
#include "limber/flexbody/modal/reduced_basis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/singular_values.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"
#include "limber/flexbody/model/multiply_mass.hpp"

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

struct Eigenpairs {
  VectorX lambda;  ///< ascending [rad^2/s^2]
  MatrixX vectors;
};

/// Of a reduced stiffness. An eigensolver has errors of eps times the highest
/// eigenvalue in all; on a slender body that is a local mode's, 1e10 times the
/// first. The singular values of the Cholesky factor span half as many decades.
Eigenpairs find_eigenpairs(const MatrixX& stiffness) {
  constexpr double kWide = 1e6;  // above it ten digits are not guaranteed
  const MatrixX K = 0.5 * (stiffness + stiffness.transpose());
  const auto [lambda, vectors] = dense::find_eigenpairs(K);
  const Eigen::Index last = lambda.size() - 1;
  if (lambda[0] * kWide > lambda[last]) return {lambda, vectors};
  const auto L = dense::find_cholesky(K);
  if (!L)
    throw NumericalError(fmt::format(
        "reduced basis: eigenvalues from {:.3g} to {:.3g} rad^2/s^2; expected "
        "all positive. A vector without stiffness is in the basis.",
        lambda[0], lambda[last]));
  const auto factor = dense::find_singular_form(*L);
  return {factor.values.reverse().cwiseAbs2(), factor.U.rowwise().reverse()};
}

}  // namespace

MatrixX orthonormalise(const MatrixX& vectors, const SparseMatrix& M_s,
                       const MatrixX& R, double drop_tolerance) {
  LIMBER_EXPECT(R.rows() == vectors.rows());
  // Rigid modes come first, so that one Gram-Schmidt loop also projects them
  // out.
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
    // Twice is enough (Giraud, Langou, Rozloznik, 2005), normalised in between,
    // so that the remainder of a nearly dependent vector is orthogonal.
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
                                const StiffnessFunction& multiply_stiffness,
                                const MatrixX& R, double drop_tolerance) {
  const MatrixX Q = orthonormalise(vectors, M_s, R, drop_tolerance);
  if (Q.cols() == 0) return {VectorX(0), Q};
  const Eigenpairs pairs =
      find_eigenpairs(Q.transpose() * multiply_stiffness(Q));
  ReducedBasis basis{pairs.lambda, Q * pairs.vectors};
  fix_signs(basis.Phi);
  return basis;
}

}  // namespace limber::flexbody
