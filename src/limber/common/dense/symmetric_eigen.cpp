// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/symmetric_eigen.hpp"

#include <Eigen/Eigenvalues>

namespace limber::dense {
namespace {

template <typename Pairs, typename Matrix>
Pairs find_pairs(const Matrix& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template <typename Matrix>
auto find_values(const Matrix& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(symmetric,
                                               Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace

Eigenpairs find_eigenpairs(const MatrixX& symmetric) {
  return find_pairs<Eigenpairs>(symmetric);
}

Eigenpairs3 find_eigenpairs(const Matrix3& symmetric) {
  return find_pairs<Eigenpairs3>(symmetric);
}

Eigenpairs6 find_eigenpairs(const Matrix6& symmetric) {
  return find_pairs<Eigenpairs6>(symmetric);
}

VectorX find_eigenvalues(const MatrixX& symmetric) {
  return find_values(symmetric);
}

Vector3 find_eigenvalues(const Matrix3& symmetric) {
  return find_values(symmetric);
}

Vector6 find_eigenvalues(const Matrix6& symmetric) {
  return find_values(symmetric);
}

VectorX find_eigenvalues(const Eigen::MatrixXcd& hermitian) {
  return find_values(hermitian);
}

Eigenpairs find_eigenpairs(const MatrixX& K, const MatrixX& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixX> solver(K, M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace limber::dense
