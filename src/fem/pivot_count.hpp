// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fem/matrices.hpp"

namespace limber::fem {

/// How many eigenvalues of a symmetric matrix are negative, by Sylvester's
/// law from the pivots of L D L^T.
struct PivotCount {
  int negative = 0;
  /// Whether no pivot was so small that its sign is roundoff.
  bool is_reliable = false;
};

/// @param lower lower triangle
[[nodiscard]] PivotCount count_negative_pivots(const SparseMatrix& lower,
                                               const std::vector<int>& order);

}  // namespace limber::fem
