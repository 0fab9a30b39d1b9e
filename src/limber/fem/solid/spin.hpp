// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/solid/elastic_inverse.hpp"

/// A body in steady rotation, in its own frame: K - Omega^2 M E.
/// docs/theory/operating_states.md.
namespace limber::fem {

/// E X: the part of a 3N x k field normal to the axis.
/// @param axis unit vector
[[nodiscard]] MatrixX project_normal(const Vector3& axis, const MatrixX& X);

/// The lowest angular speed at which centrifugal softening cancels the
/// stiffness of a deformation [rad/s].
///
/// Equation   smallest Omega with K x = Omega^2 P^T M E x for an x without
///            rigid motion
/// Source     Lanczos on K^+ M E in the inner product of K (Spectra)
/// @param axis unit vector
/// @throws NumericalError if Lanczos does not converge.
[[nodiscard]] double find_critical_speed(const ElasticInverse& inverse,
                                         const Vector3& axis);

/// Deformation under loads F in a frame that rotates at `speed`, without rigid
/// motion: the supports of the body carry the rigid part of F and of Omega^2 M
/// E x.
///
/// Equation   P^T (K - Omega^2 M E) x = P^T F, x = P x
/// Source     Conjugate gradients preconditioned with the factor of K, which
///            needs no other factorisation, repeated on the residual
/// @param axis unit vector; @param speed below the critical one [rad/s]
/// @throws NumericalError if the matrix is not positive definite (the speed
/// is critical or above) or the iteration stalls.
[[nodiscard]] VectorX solve_spun(const ElasticInverse& inverse,
                                 const Vector3& axis, double speed,
                                 const VectorX& F);

}  // namespace limber::fem
