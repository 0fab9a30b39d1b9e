// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// Part of limber_reduction.
namespace limber::flexbody {

/// Least squares |A x - b| over x >= 0.
struct NonnegativeFit {
  VectorX x;
  double residual = 0.0;  ///< |A x - b| / |b| [-]
};

/// Source     Lawson, Hanson, Solving Least Squares Problems (1974), ch. 23
/// @param A columns of any scale; one of zeros gets 0 @param b not zero
[[nodiscard]] NonnegativeFit fit_nonnegative(const MatrixX& A,
                                             const VectorX& b);

}  // namespace limber::flexbody
