// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/reduction/matrices/matrix_system.hpp"

/// Checks of matrices by themselves. Part of limber_reduction.
namespace limber::flexbody {

/// @throws InputError for entries that are not finite, one triangle without the
/// other, or a difference of the triangles above their digits
void check_symmetry(const MatrixSystem& system);

/// Necessary for matrices that are positive semidefinite: A_ii >= 0 and A_ij^2
/// <= A_ii A_jj, by which off-diagonals that are doubled show.
/// @throws InputError naming the worst node
void check_minors(const MatrixSystem& system);

/// Whether M + 1e-8 diag(M) has a Cholesky factor.
/// @throws InputError if not
void check_positive_mass(const MatrixSystem& system);

}  // namespace limber::flexbody
