// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/types.hpp"

namespace limber::flexbody {

/// Few directions that span many columns.
struct ForceDirections {
  MatrixX Q;             ///< n x r, orthonormal
  MatrixX R;             ///< r x T, F = Q R but for what was left out
  bool is_whole = true;  ///< false: there were more than asked for
};

/// Directions of the columns of F, the one farthest from those found first:
/// QR with column pivoting that stops when every column is found to `tolerance`
/// of the longest one, or after `most` directions. A history of forces has
/// thousands of columns and few directions, and costs 4 n T r operations and no
/// copy of F.
///
/// Source     Golub and Van Loan, Matrix Computations, sec. 5.4.2, by
///            Gram-Schmidt done twice.
/// @param F n x T; @param tolerance > 1e-7, because lengths are updated [-]
[[nodiscard]] ForceDirections find_force_directions(const MatrixX& F,
                                                    double tolerance,
                                                    Eigen::Index most);

}  // namespace limber::flexbody
