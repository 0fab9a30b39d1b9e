// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/general_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace limber::dense {

std::optional<ComplexSchur> find_complex_schur(const Eigen::MatrixXcd& A) {
  const Eigen::ComplexSchur<Eigen::MatrixXcd> schur(A);
  if (schur.info() != Eigen::Success) return std::nullopt;
  return ComplexSchur{schur.matrixU(), schur.matrixT()};
}

GeneralEigenpairs find_general_eigenpairs(const MatrixX& A, bool with_vectors) {
  const Eigen::EigenSolver<MatrixX> solver(A, with_vectors);
  GeneralEigenpairs pairs{solver.eigenvalues(), {}};
  if (with_vectors) pairs.vectors = solver.eigenvectors();
  return pairs;
}

}  // namespace limber::dense
