// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::dense {

/// exp(A) of square matrices of one size, without allocation.
///
/// Equation   (sum_k (A / 2^s)^k / k!)^(2^s) with |A| / 2^s <= 1/2
/// Source     Moler and Van Loan, "Nineteen dubious ways to compute the
///            exponential of a matrix, twenty-five years later", SIAM Review
///            45, 2003, method 3
/// Limits     errors are round-off times about 1 + |A| for matrices whose
///            exponentials do not grow, if they are scaled to be nearly normal
class Exponential {
 public:
  /// @param size rows of the matrices
  explicit Exponential(Eigen::Index size);

  /// Valid until the next call. @param A finite, size x size
  const MatrixX& operator()(const MatrixX& A);

 private:
  MatrixX scaled_, term_, sum_, next_;
};

}  // namespace limber::dense
