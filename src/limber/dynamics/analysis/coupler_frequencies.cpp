// SPDX-License-Identifier: BSD-3-Clause
#include "limber/dynamics/analysis/coupler_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limber/common/dense/linear_solve.hpp"
#include "limber/common/dense/symmetric_eigen.hpp"
#include "limber/common/errors.hpp"

namespace limber::dynamics {

VectorX find_coupler_frequencies(const SmallMotion& motion,
                                 Eigen::Index count) {
  const auto L = dense::find_cholesky(motion.M);
  LIMBER_EXPECT(L.has_value());
  // L^-1 G', whose squares are the mobilities of the couplers.
  const MatrixX half =
      dense::solve_lower(*L, motion.G.topRows(6 * count).transpose());
  VectorX frequencies(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Matrix6& K = motion.K[static_cast<std::size_t>(i)];
    const auto columns = half.middleCols(6 * i, 6);
    const Matrix6 mobility = columns.transpose() * columns;
    const dense::Eigenpairs6 pairs = dense::find_eigenpairs(mobility);
    const Matrix6 root =
        pairs.vectors * pairs.values.cwiseMax(0.0).cwiseSqrt().asDiagonal();
    const Matrix6 product =
        root.transpose() * (0.5 * (K + K.transpose())) * root;
    const double largest = dense::find_eigenvalues(product).maxCoeff();
    frequencies[i] =
        std::sqrt(std::max(largest, 0.0)) / (2.0 * std::numbers::pi);
  }
  return frequencies;
}

}  // namespace limber::dynamics
