// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// M X. Same result for any thread count.
/// @param M_s both triangles: a scalar nodal mass, N x N for 3N rows of X,
/// M = M_s (x) I_3; or M itself, as many rows as X
[[nodiscard]] MatrixX multiply_mass(const SparseMatrix& M_s, const MatrixX& X);

/// K X, K given by its lower triangle.
[[nodiscard]] MatrixX multiply_stiffness(const SparseMatrix& K_lower,
                                         const MatrixX& X);

/// Rows and columns `kept` (sorted) of a matrix.
[[nodiscard]] SparseMatrix restrict_matrix(const SparseMatrix& full,
                                           const std::vector<int>& kept);

}  // namespace limber::fem
