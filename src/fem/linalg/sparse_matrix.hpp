// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// (M_s (x) I_3) X for 3N x k columns. Same result for any thread count.
[[nodiscard]] MatrixX multiply_mass(const SparseMatrix& M_s, const MatrixX& X);

/// K X, K given by its lower triangle.
[[nodiscard]] MatrixX multiply_stiffness(const SparseMatrix& K_lower,
                                         const MatrixX& X);

/// Rows and columns `kept` (sorted) of a matrix.
[[nodiscard]] SparseMatrix restrict_matrix(const SparseMatrix& full,
                                           const std::vector<int>& kept);

}  // namespace limber::fem
