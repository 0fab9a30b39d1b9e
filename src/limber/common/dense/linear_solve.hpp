// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/types.hpp"

/// Linear equations with square matrices of n rows; B has n rows and any number
/// of columns.
namespace limber::dense {

/// A^-1 B by elimination with row pivoting. Of a singular A the result is not
/// finite.
[[nodiscard]] MatrixX solve(const MatrixX& A, const MatrixX& B);
[[nodiscard]] VectorX solve(const MatrixX& A, const VectorX& b);
[[nodiscard]] Eigen::MatrixXcd solve(const Eigen::MatrixXcd& A,
                                     const Eigen::MatrixXcd& B);
[[nodiscard]] MatrixX find_inverse(const MatrixX& A);

/// L, lower triangular, of the symmetric A = L L^T, of which the lower triangle
/// is read.
/// @returns nothing if A is not positive definite or has a NaN
[[nodiscard]] std::optional<MatrixX> find_cholesky(const MatrixX& A);
/// L of the Hermitian A = L L*; of an A that is not positive definite the
/// result is not meaningful.
[[nodiscard]] Eigen::MatrixXcd find_cholesky(const Eigen::MatrixXcd& A);

/// L^-1 B of the lower triangle L.
[[nodiscard]] MatrixX solve_lower(const MatrixX& L, const MatrixX& B);
[[nodiscard]] Eigen::MatrixXcd solve_lower(const Eigen::MatrixXcd& L,
                                           const Eigen::MatrixXcd& B);
/// L^-T B of the lower triangle L.
[[nodiscard]] MatrixX solve_lower_transposed(const MatrixX& L,
                                             const MatrixX& B);
/// B := B L^-T of the lower triangle L.
void divide_by_lower_transposed(const MatrixX& L, Eigen::Ref<MatrixX> B);

/// U^-1 b of the upper triangle U.
[[nodiscard]] Eigen::VectorXcd solve_upper(const Eigen::MatrixXcd& U,
                                           const Eigen::VectorXcd& b);

}  // namespace limber::dense
