// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::fem {

/// Weights of values at places of a plane that give, at its origin, the value
/// of the linear polynomial of least squares through them. They reproduce
/// linear fields exactly; equal weights, the mean, where the places determine
/// none: fewer than three, or on a line.
///
/// Source     superconvergent patch recovery [@zienkiewicz1992]
/// @param places 2 x n, n >= 1 @returns n, their sum is 1
[[nodiscard]] VectorX find_linear_fit(
    const Eigen::Matrix<double, 2, Eigen::Dynamic>& places);

}  // namespace limber::fem
