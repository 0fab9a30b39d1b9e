// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// Orthogonal factors of a matrix of r rows and c columns, and least squares,
/// by Householder reflections [@golub1996, 5.2 to 5.4].
namespace limber::dense {

/// The first `columns` columns of Q, r x r, of A = Q R. Those after the first
/// c are orthogonal to A's columns.
[[nodiscard]] MatrixX find_q(const MatrixX& A, Eigen::Index columns);

/// R of A = Q R, c x c and upper triangular; A has at least as many rows as
/// columns. Its diagonal may have any sign.
[[nodiscard]] MatrixX find_r(const MatrixX& A);

/// Of A P = Q R, the columns in the order that pivoting chooses.
struct PivotedQ {
  MatrixX Q;              ///< r x r; the first `rank` columns span A's
  Eigen::Index rank = 0;  ///< pivots above `threshold` times the largest
};
[[nodiscard]] PivotedQ find_pivoted_q(const MatrixX& A, double threshold);

/// x that minimises |A x - b|, separately for each column of b.
struct LeastSquares {
  MatrixX x;              ///< c x b's columns
  Eigen::Index rank = 0;  ///< pivots above `threshold` times the largest
};
/// Beyond `rank`, coefficients are zero.
[[nodiscard]] LeastSquares solve_least_squares(const MatrixX& A,
                                               const MatrixX& b,
                                               double threshold);
/// The threshold is round-off, eps times the lesser of r and c.
[[nodiscard]] MatrixX solve_least_squares(const MatrixX& A, const MatrixX& b);

}  // namespace limber::dense
