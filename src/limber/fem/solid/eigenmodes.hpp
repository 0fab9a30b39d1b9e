// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/progress.hpp"
#include "limber/fem/solid/elastic_inverse.hpp"

namespace limber::fem {

struct Eigenmodes {
  VectorX lambda;  ///< ascending [rad^2/s^2]
  MatrixX Phi;     ///< 3N x count, M-orthonormal, no rigid motion [kg^-1/2]
};

/// The `count` lowest elastic eigenmodes.
///
/// Equation   K phi = lambda M phi
/// Source     Block Lanczos on (K - s M)^-1 M with full orthogonalisation
///            (Grimes, Lewis and Simon, SIAM J. Matrix Anal. Appl. 15, 1994)
///            and thick restart. Where more modes may share an eigenvalue than
///            a block has columns, it is repeated in the complement of what was
///            found until that holds no lower mode.
/// @throws InputError if there are fewer elastic modes than `count`;
/// NumericalError if a residual misses its tolerance or a mode does not
/// converge.
[[nodiscard]] Eigenmodes find_eigenmodes(const ElasticInverse& inverse,
                                         int count,
                                         const Progress& progress = {});

}  // namespace limber::fem
