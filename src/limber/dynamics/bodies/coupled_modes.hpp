// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/dense/lu_factors.hpp"
#include "limber/common/types.hpp"

namespace limber::dynamics {

/// Factors of the dense modal block of a body whose elasticity couples its
/// modes.
///
/// Equation   A = c + v zeta + K, not symmetric where K is that of a step
/// Limits     factoring allocates. Factors that are kept are inverted after
///            kSolvesByFactors solutions: a product costs less than half of
///            a solution, an inverse about 20 of them (measured with 20
///            modes)
class CoupledModes {
 public:
  explicit CoupledModes(Eigen::Index modes);

  /// A = diag(diagonal) + K, both [1/s^2].
  /// @returns whether it is regular
  [[nodiscard]] bool factor(const VectorX& diagonal, const MatrixX& K);

  /// x := A^-1 x
  void solve(Eigen::Ref<VectorX> x);
  /// Rows: X := X A^-T, six at a time.
  void solve_rows(const Eigen::Ref<const Matrix6X>& rows,
                  Eigen::Ref<Matrix6X> result) const;
  /// A itself [1/s^2].
  [[nodiscard]] const MatrixX& matrix() const { return A_; }

 private:
  static constexpr int kSolvesByFactors = 16;

  MatrixX A_;
  dense::LuFactors factors_;
  MatrixX inverse_;
  int solves_ = 0;  // since the factors were made
  VectorX product_;
};

}  // namespace limber::dynamics
