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
  /// Whether the factor did not grow, so that the signs are not roundoff.
  bool is_reliable = false;
};

/// @param lower lower triangle
[[nodiscard]] PivotCount count_negative_pivots(const SparseMatrix& lower,
                                               const std::vector<int>& order);

}  // namespace limber::fem
