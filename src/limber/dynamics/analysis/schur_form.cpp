// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/schur_form.hpp"

#include <Eigen/Jacobi>
#include <cmath>

#include "limber/common/dense/general_eigen.hpp"
#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {
namespace {

using Index = Eigen::Index;
using Complex = std::complex<double>;

// Exchanges the eigenvalues k and k + 1.
void exchange(SchurForm& form, Index k) {
  Eigen::MatrixXcd& T = form.T;
  Eigen::JacobiRotation<Complex> rotation;
  rotation.makeGivens(T(k, k + 1), T(k + 1, k + 1) - T(k, k));
  T.applyOnTheLeft(k, k + 1, rotation.adjoint());
  T.applyOnTheRight(k, k + 1, rotation);
  form.U.applyOnTheRight(k, k + 1, rotation);
  T(k + 1, k) = 0.0;
}

}  // namespace

SchurForm find_schur_form(
    const MatrixX& A,
    const std::function<bool(const std::complex<double>&)>& comes_first) {
  auto schur = dense::find_complex_schur(A.cast<Complex>());
  if (!schur) {
    throw NumericalError("the eigenvalues of the linear model do not converge");
  }
  SchurForm form{std::move(schur->U), std::move(schur->T)};
  if (!comes_first) return form;
  Index first = 0;
  for (Index i = 0; i < form.T.rows(); ++i) {
    if (!comes_first(form.T(i, i))) continue;
    for (Index k = i; k > first; --k) exchange(form, k - 1);
    ++first;
  }
  return form;
}

Eigen::MatrixXcd find_gramian_factor(const Eigen::MatrixXcd& T,
                                     const Eigen::MatrixXcd& B) {
  const Index n = T.rows();
  Eigen::MatrixXcd L = Eigen::MatrixXcd::Zero(n, n);
  Eigen::MatrixXcd left = B;  // what is not yet accounted for
  for (Index j = n - 1; j >= 0; --j) {
    const double size = left.row(j).norm();
    if (size == 0.0) continue;
    const Complex value = T(j, j);
    const double alpha = std::sqrt(-2.0 * value.real());
    const Eigen::VectorXcd direction = left.row(j).adjoint() / size;
    L(j, j) = size / alpha;
    if (j == 0) break;
    const Eigen::MatrixXcd shifted =
        T.topLeftCorner(j, j) +
        std::conj(value) * Eigen::MatrixXcd::Identity(j, j);
    L.col(j).head(j) = dense::solve_upper(
        shifted,
        -(T.col(j).head(j) * L(j, j) + alpha * (left.topRows(j) * direction)));
    left.topRows(j) -= alpha * L.col(j).head(j) * direction.adjoint();
  }
  return L;
}

Eigen::MatrixXcd solve_sylvester(const Eigen::MatrixXcd& T1,
                                 const Eigen::MatrixXcd& T2,
                                 const Eigen::MatrixXcd& R) {
  const Index n = T1.rows();
  Eigen::MatrixXcd X(n, T2.cols());
  for (Index k = 0; k < T2.cols(); ++k) {
    const Eigen::MatrixXcd shifted =
        T1 - T2(k, k) * Eigen::MatrixXcd::Identity(n, n);
    X.col(k) = dense::solve_upper(shifted,
                                  R.col(k) + X.leftCols(k) * T2.col(k).head(k));
  }
  return X;
}

}  // namespace limber::dynamics
