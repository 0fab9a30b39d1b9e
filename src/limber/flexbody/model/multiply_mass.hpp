// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// M X. @param M_s both triangles: a scalar nodal mass, N x N for 3N rows of X,
/// M = M_s (x) I_3 [kg]; or M itself, as many rows as X
[[nodiscard]] MatrixX multiply_mass(const Eigen::SparseMatrix<double>& M_s,
                                    const MatrixX& X);

}  // namespace limber::flexbody
