// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// A = U diag(values) V^T, singular values descending, the columns of U and V
/// orthonormal.
namespace limber::dense {

/// Of a matrix of r rows and c columns.
struct SingularForm {
  VectorX values;  ///< min(r, c)
  MatrixX U;       ///< r x r
  MatrixX V;       ///< c x c
};
struct SingularForm3 {
  Vector3 values;
  Matrix3 U;
  Matrix3 V;
};

/// By Jacobi rotations: small singular values keep their digits. For up to a
/// few hundred rows.
[[nodiscard]] SingularForm find_singular_form(const MatrixX& A);
[[nodiscard]] SingularForm3 find_singular_form(const Matrix3& A);

struct RightSingularForm {
  VectorX values;  ///< min(r, c)
  MatrixX V;       ///< c x c
};

/// By divide and conquer: fast for large matrices; errors are relative to the
/// largest singular value.
[[nodiscard]] RightSingularForm find_right_singular_form(const MatrixX& A);

}  // namespace limber::dense
