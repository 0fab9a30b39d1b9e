// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// The part of each mode that contacts have. Part of limber_reduction.
namespace limber::flexbody {

/// Squares of the fractions s_k of modes that a contact along one direction
/// has, so that a sum that ends with the basis does not overshoot.
///
/// Equation   s_k^2 = 1 - u^4, u = omega_k (N + 1/2) / (N omega_N), at most 1;
///            N modes have more than 1e-4 of the flexibility, omega_N is the
///            highest frequency among them; all 1 without any
/// @param flexibility of each mode along the direction [m/N]
/// @param lambda their eigenvalues [rad^2/s^2]
[[nodiscard]] VectorX find_roll_off(const VectorX& flexibility,
                                    const VectorX& lambda);

}  // namespace limber::flexbody
