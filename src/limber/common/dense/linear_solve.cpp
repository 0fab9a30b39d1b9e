// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/linear_solve.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <utility>

namespace limber::dense {

MatrixX solve(const MatrixX& A, const MatrixX& B) {
  return A.partialPivLu().solve(B);
}

VectorX solve(const MatrixX& A, const VectorX& b) {
  return A.partialPivLu().solve(b);
}

Eigen::MatrixXcd solve(const Eigen::MatrixXcd& A, const Eigen::MatrixXcd& B) {
  return A.partialPivLu().solve(B);
}

MatrixX find_inverse(const MatrixX& A) { return A.inverse(); }

std::optional<MatrixX> find_cholesky(const MatrixX& A) {
  const Eigen::LLT<MatrixX> factor(A);
  MatrixX L = factor.matrixL();
  const bool is_positive =
      factor.info() == Eigen::Success && L.diagonal().allFinite();
  return is_positive ? std::optional(std::move(L)) : std::nullopt;
}

Eigen::MatrixXcd find_cholesky(const Eigen::MatrixXcd& A) {
  return A.llt().matrixL();
}

MatrixX solve_lower(const MatrixX& L, const MatrixX& B) {
  return L.triangularView<Eigen::Lower>().solve(B);
}

Eigen::MatrixXcd solve_lower(const Eigen::MatrixXcd& L,
                             const Eigen::MatrixXcd& B) {
  return L.triangularView<Eigen::Lower>().solve(B);
}

MatrixX solve_lower_transposed(const MatrixX& L, const MatrixX& B) {
  return L.triangularView<Eigen::Lower>().transpose().solve(B);
}

void divide_by_lower_transposed(const MatrixX& L, Eigen::Ref<MatrixX> B) {
  L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(
      B);
}

Eigen::VectorXcd solve_upper(const Eigen::MatrixXcd& U,
                             const Eigen::VectorXcd& b) {
  return U.triangularView<Eigen::Upper>().solve(b);
}

}  // namespace limber::dense
