// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

namespace limber::flexbody {

/// Few directions that span many columns.
struct ForceDirections {
  MatrixX Q;             ///< n x r, orthonormal [-]
  MatrixX R;             ///< r x T, F = Q R within the tolerance [as F]
  bool is_whole = true;  ///< false: there were more than `most`
};

/// Orthonormal directions of the columns of F: QR with column pivoting that
/// stops when every column is represented to `tolerance` of the longest one, or
/// after `most` directions. A force history has thousands of columns and few
/// directions; the cost is 4 n T r operations and no copy of F.
///
/// Source     Golub and Van Loan, Matrix Computations, sec. 5.4.2, with
///            repeated Gram-Schmidt.
/// @param F n x T; @param tolerance > 1e-7, since lengths are updated [-]
[[nodiscard]] ForceDirections find_force_directions(const MatrixX& F,
                                                    double tolerance,
                                                    Eigen::Index most);

}  // namespace limber::flexbody
