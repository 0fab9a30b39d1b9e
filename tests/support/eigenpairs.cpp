// SPDX-License-Identifier: BSD-3-Clause
#include "support/eigenpairs.hpp"

#include <Eigen/Eigenvalues>

namespace limber::testing {

Eigenpairs find_eigenpairs(const MatrixX& K, const MatrixX& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(K, M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorX find_eigenvalues(const MatrixX& K, const MatrixX& M) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX>(
             K, M, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

VectorX find_eigenvalues(const MatrixX& A) {
  return Eigen::SelfAdjointEigenSolver<MatrixX>(A, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace limber::testing
