// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/common/types.hpp"

/// Checks of parameters of modal elasticity. Each throws InputError.
namespace limber::flexbody {

/// Finite, and not negative [rad^2/s^2].
void check_eigenvalues(const VectorX& lambda);

/// Rows and columns. @param what names the table
void check_shape(const std::string& what, const MatrixX& table,
                 Eigen::Index rows, Eigen::Index columns);

/// Every entry finite.
void check_finite(const std::string& what, const MatrixX& table);

}  // namespace limber::flexbody
