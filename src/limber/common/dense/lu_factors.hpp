// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/LU>

#include "limber/common/types.hpp"

namespace limber::dense {

/// Factors of a square matrix A, n x n, for many solutions: P A = L U.
///
/// Limits     factoring and inverse() allocate, solutions do not
class LuFactors {
 public:
  /// Of the identity.
  explicit LuFactors(Eigen::Index n);

  /// @returns whether A is regular: all pivots finite and not zero
  [[nodiscard]] bool factor(const MatrixX& A);
  /// x := A^-1 x, of n rows.
  void solve(Eigen::Ref<VectorX> x);
  /// Six rows at a time: result := rows A^-T, both 6 x n, two places.
  void solve_rows(const Eigen::Ref<const Matrix6X>& rows,
                  Eigen::Ref<Matrix6X> result) const;
  [[nodiscard]] MatrixX inverse() const;

 private:
  Eigen::PartialPivLU<MatrixX> lu_;
  VectorX scratch_;
};

}  // namespace limber::dense
