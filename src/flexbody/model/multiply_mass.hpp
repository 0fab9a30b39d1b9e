// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// (M_s (x) I_3) X for 3N x k columns.
/// @param M_s N x N, both triangles [kg]
[[nodiscard]] MatrixX multiply_mass(const Eigen::SparseMatrix<double>& M_s,
                                    const MatrixX& X);

}  // namespace limber::flexbody
