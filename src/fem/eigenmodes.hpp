// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress.hpp"
#include "fem/elastic_inverse.hpp"

namespace limber::fem {

struct Eigenmodes {
  VectorX lambda;  ///< ascending [rad^2/s^2]
  MatrixX Phi;     ///< 3N x count, M-orthonormal, no rigid motion [kg^-1/2]
};

/// The `count` lowest elastic eigenmodes.
///
/// Equation   K phi = lambda M phi
/// Source     Block Lanczos on (K - s M)^-1 M with full reorthogonalisation
///            (Grimes, Lewis, Simon, SIAM J. Matrix Anal. 15, 1994): a block
///            finds repeated eigenvalues that single vectors meet by roundoff
///            alone. No mode is missed: the negative pivots of K - t M, t
///            above the last mode, are counted (Sylvester) where affordable.
/// @throws InputError if there are fewer elastic modes than `count`;
/// NumericalError if a residual misses its tolerance or a mode stays missing.
[[nodiscard]] Eigenmodes find_eigenmodes(const ElasticInverse& inverse,
                                         int count,
                                         const Progress& progress = {});

}  // namespace limber::fem
