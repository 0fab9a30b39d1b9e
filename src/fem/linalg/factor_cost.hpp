// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fem/matrices.hpp"

namespace limber::fem {

/// About how long factors of a solid's stiffness take [s].
///
/// Equation   t = 27 f / r: f the operations of factors of the nodes' pattern,
///            three components a node make 27 times as many
/// Source     f by CHOLMOD's analysis; r measured (factor_cost.cpp)
/// Limits     of a processor of its kind; of small meshes too short, since
///            their fronts are small
/// @param M_s pattern of the nodes @param nodes fill-reducing order of them
[[nodiscard]] double estimate_factor_seconds(const SparseMatrix& M_s,
                                             const std::vector<int>& nodes);

}  // namespace limber::fem
