// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/matrices/matrix_system.hpp"
#include "limber/reduction/matrices/rigid_motion.hpp"

/// Inertia shape integrals from a mass matrix alone. Part of limber_reduction.
namespace limber::flexbody {

/// M read by nodes: translations t and rotations r of all nodes, 3N x 3N each.
struct MassBlocks {
  explicit MassBlocks(const MatrixSystem& system);

  fem::SparseMatrix tt;
  fem::SparseMatrix tr;
  /// D_ij = (tr(M_rr,ij)/2 I - M_rr,ij)^T = int d_i d_j^T dm [kg m^2]
  fem::SparseMatrix D;
};

/// int x x^T dm about `center` as the blocks give it, [kg m^2].
[[nodiscard]] Matrix3 read_second_moments(const MatrixSystem& system,
                                          const MassBlocks& blocks,
                                          const Vector3& center);

/// Departure of the blocks' moments of inertia from X_r^T M X_r, of its largest
/// entry [-]: how far M is from that of a field u(p) = sum N_i u_i + theta_i x
/// d_i(p), which all tables assume.
[[nodiscard]] double calc_block_defect(const MatrixSystem& system,
                                       const MassBlocks& blocks,
                                       const RigidInertia& inertia);

/// The integrals of InertiaShapeIntegrals for modes of a general mass matrix.
///
/// Equation   u(p) = sum N_i(p) u_i + theta_i x d_i(p): M_tt,ij = int N_i N_j
/// dm,
///            M_tr,ij = -int N_i hat(d_j) dm, M_rr,ij = int hat(d_i)^T hat(d_j)
///            dm. J0 = X_r^T M X_r; with Y = M X_r and, of node i, Q_i its
///            rotation rows, E_i = tr(Q_i)/2 I - Q_i = int y d_i^T dm:
///            J1_k = A_k + A_k^T from Y_t, E, phi_k; S0 = tr(J0)/2 I - J0,
///            S1_k = (tr(J1_k)/2 I - J1_k)/2 + hat-part of X_r^T M phi_k / 2;
///            S2_kl = int u_k u_l^T dm from tt, tr and D; P = X_t^T M Phi
/// Source     shape integrals [@shabana2013, ch. 5] of that field; tr S2_kl =
///            phi_k^T M phi_l holds exactly
/// Limits     exact for M = M_s (x) I_3, lumped masses with inertia and offset,
///            and interpolation that is the same in all directions (plates);
///            for consistent beams the error falls with the elements' size
/// @param X rigid motions about the centre of mass, rows x 6
/// @param Phi rows x m; zero on rows that are held
[[nodiscard]] InertiaShapeIntegrals calc_block_integrals(
    const MatrixSystem& system, const MassBlocks& blocks, const MatrixX& X,
    const MatrixX& Phi);

/// Scalar nodal mass tr(M_tt,ij)/3, N x N [kg].
[[nodiscard]] fem::SparseMatrix find_scalar_mass(const MassBlocks& blocks);

}  // namespace limber::flexbody
