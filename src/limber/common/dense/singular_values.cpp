// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/singular_values.hpp"

#include <Eigen/SVD>

namespace limber::dense {

SingularForm find_singular_form(const MatrixX& A) {
  const Eigen::JacobiSVD<MatrixX> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

SingularForm3 find_singular_form(const Matrix3& A) {
  const Eigen::JacobiSVD<Matrix3> svd(
      A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

RightSingularForm find_right_singular_form(const MatrixX& A) {
  const Eigen::BDCSVD<MatrixX> svd(A, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace limber::dense
