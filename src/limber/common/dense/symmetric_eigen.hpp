// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// Eigenvalues and eigenvectors of symmetric matrices. Only the lower triangle
/// is read. Eigenvalues ascend; eigenvectors are the columns, of unit length
/// and orthogonal, of arbitrary sign. NaN in the matrix gives NaN.
///
/// Source     Householder tridiagonalisation and implicit QR: Golub and Van
///            Loan, Matrix Computations, 3rd ed., 8.3 [@golub1996]
namespace limber::dense {

struct Eigenpairs {
  VectorX values;   ///< n
  MatrixX vectors;  ///< n x n
};
struct Eigenpairs3 {
  Vector3 values;
  Matrix3 vectors;
};
struct Eigenpairs6 {
  Vector6 values;
  Matrix6 vectors;
};

[[nodiscard]] Eigenpairs find_eigenpairs(const MatrixX& symmetric);
[[nodiscard]] Eigenpairs3 find_eigenpairs(const Matrix3& symmetric);
[[nodiscard]] Eigenpairs6 find_eigenpairs(const Matrix6& symmetric);

[[nodiscard]] VectorX find_eigenvalues(const MatrixX& symmetric);
[[nodiscard]] Vector3 find_eigenvalues(const Matrix3& symmetric);
[[nodiscard]] Vector6 find_eigenvalues(const Matrix6& symmetric);
/// Of a Hermitian matrix.
[[nodiscard]] VectorX find_eigenvalues(const Eigen::MatrixXcd& hermitian);

/// K x = lambda M x; M positive definite; the vectors are M-orthonormal.
[[nodiscard]] Eigenpairs find_eigenpairs(const MatrixX& K, const MatrixX& M);

}  // namespace limber::dense
