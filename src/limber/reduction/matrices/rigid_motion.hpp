// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/reduction/matrices/matrix_system.hpp"

/// Rigid motions of a model given by matrices. Part of limber_reduction.
namespace limber::flexbody {

/// Unit translations along and rotations about the axes of the origin, rows
/// x 6. Rows of unknown kind, and those without a node, follow from the
/// stiffness.
///
/// Equation   X_t = e_a; x_a = e_a x x_n, theta = e_a; K_uu X_u = -K_uk X_k
/// Limits     infinitesimal, so rows of unknown kind must be at rest under
///            rigid motion: no spring to ground
/// @throws InputError if the stiffness does not determine the unknown rows
[[nodiscard]] MatrixX make_rigid_motions(const MatrixSystem& system);

/// The same about a point [m].
[[nodiscard]] MatrixX move_origin(const MatrixX& X, const Vector3& point);

/// Inertia of the rigid motions.
struct RigidInertia {
  double mass = 0.0;                 ///< [kg]
  Vector3 center = Vector3::Zero();  ///< of mass [m]
  Matrix3 J0 = Matrix3::Zero();      ///< about the centre of mass [kg m^2]
  /// Largest departure of X' M X from that of a rigid body: |M_tt - m I| / m
  /// and the same of the first moments [-].
  double defect = 0.0;
};

/// Source     X^T M X of a rigid body is [m I, -m hat(c); m hat(c), J]
/// @param X about the origin
[[nodiscard]] RigidInertia calc_rigid_inertia(const MatrixSystem& system,
                                              const MatrixX& X);

}  // namespace limber::flexbody
