// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/dense/qr.hpp"

#include <Eigen/QR>

namespace limber::dense {

MatrixX find_q(const MatrixX& A, Eigen::Index columns) {
  const Eigen::HouseholderQR<MatrixX> qr(A);
  return qr.householderQ() * MatrixX::Identity(A.rows(), columns);
}

MatrixX find_r(const MatrixX& A) {
  const Eigen::HouseholderQR<MatrixX> qr(A);
  return qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

PivotedQ find_pivoted_q(const MatrixX& A, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixX> qr(A);
  qr.setThreshold(threshold);
  return {qr.householderQ() * MatrixX::Identity(A.rows(), A.rows()), qr.rank()};
}

LeastSquares solve_least_squares(const MatrixX& A, const MatrixX& b,
                                 double threshold) {
  Eigen::ColPivHouseholderQR<MatrixX> qr(A);
  qr.setThreshold(threshold);
  return {qr.solve(b), qr.rank()};
}

MatrixX solve_least_squares(const MatrixX& A, const MatrixX& b) {
  return Eigen::ColPivHouseholderQR<MatrixX>(A).solve(b);
}

}  // namespace limber::dense
