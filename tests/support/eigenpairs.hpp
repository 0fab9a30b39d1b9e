// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"

/// Dense eigenproblems of small models: independent of the library's solvers.
/// Of symmetric matrices, values ascending.
namespace limber::testing {

/// K x = value M x, M positive definite.
struct Eigenpairs {
  VectorX values;
  MatrixX vectors;  ///< columns, orthonormal in M
};
[[nodiscard]] Eigenpairs find_eigenpairs(const MatrixX& K, const MatrixX& M);
[[nodiscard]] VectorX find_eigenvalues(const MatrixX& K, const MatrixX& M);

[[nodiscard]] VectorX find_eigenvalues(const MatrixX& A);

}  // namespace limber::testing
