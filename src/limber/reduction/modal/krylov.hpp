// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/modal/elastic_body.hpp"

namespace limber::flexbody {

/// The span of x_n = (K^+ M)^n x_0, n < terms, for each column x_0 of `first`.
/// With one term `first` itself; otherwise M-orthonormal columns, each block
/// from K^+ M times the orthonormal block before it, because plain powers
/// converge to the first mode until they differ only by round-off.
///
/// Source     [@ligterink2005, section 5]
/// @param first 3n x inputs on the free nodes, without rigid motion [m]
/// @param drop_tolerance as orthonormalise's [-]
/// @return fewer than terms * inputs columns where the span is exhausted
[[nodiscard]] MatrixX find_krylov_vectors(const ElasticBody& body,
                                          const MatrixX& first, int terms,
                                          double drop_tolerance);

}  // namespace limber::flexbody
