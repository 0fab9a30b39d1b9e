// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/linalg/sparse_matrix.hpp"

namespace limber::fem {

/// Estimated time to factor a solid's stiffness matrix [s].
///
/// Equation   t = 27 f / r: f the operations to factor the nodes' pattern,
///            times 27 for three components a node
/// Source     f by CHOLMOD's analysis; r measured (factor_cost.cpp)
/// Limits     for a processor of that kind; too short for small meshes, since
///            their fronts are small
/// @param M_s pattern of the nodes @param nodes fill-reducing order of them
[[nodiscard]] double estimate_factor_seconds(const SparseMatrix& M_s,
                                             const std::vector<int>& nodes);

}  // namespace limber::fem
