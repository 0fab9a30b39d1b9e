// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fem/matrices.hpp"

namespace limber::fem {

/// How many eigenvalues of a symmetric matrix are negative.
///
/// Source     Sylvester's law of inertia: as many as L D L^T has negative
///            pivots, exact whatever the order of elimination.
struct PivotCount {
  int negative = 0;
  /// Largest L_ij^2 |d_j| / |a_ii|: by how much elimination multiplies the
  /// roundoff of A. At most 1 for a definite matrix; infinite or NaN if a
  /// pivot vanished.
  double growth = 0.0;
};

/// @param lower lower triangle
[[nodiscard]] PivotCount count_negative_pivots(const SparseMatrix& lower,
                                               const std::vector<int>& order);

}  // namespace limber::fem
