// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/linalg/linear_fit.hpp"

#include "limber/common/dense/qr.hpp"

namespace limber::fem {

VectorX find_linear_fit(
    const Eigen::Matrix<double, 2, Eigen::Dynamic>& places) {
  constexpr double kOnALine = 1e-6;
  const Eigen::Index n = places.cols();
  const double size = places.colwise().norm().maxCoeff();
  if (n >= 3 && size > 0.0) {
    MatrixX P(n, 3);
    P << VectorX::Ones(n), places.transpose() / size;
    const dense::LeastSquares fit =
        dense::solve_least_squares(P, MatrixX::Identity(n, n), kOnALine);
    if (fit.rank == 3) return fit.x.row(0).transpose();
  }
  return VectorX::Constant(n, 1.0 / static_cast<double>(n));
}

}  // namespace limber::fem
