// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>

#include "limber/common/types.hpp"
#include "limber/flexbody/model/reduced_body.hpp"

/// How fast a free body may rotate before the inertial forces in its own frame
/// matter: the boundary between `uncoupled` and the higher levels, in the plane
/// of angular acceleration alpha and angular velocity Omega.
/// docs/theory/choosing.md.
namespace limber::flexbody {

/// The report's force-limited boundary on |alpha| + |Omega|^2 [1/s^2].
///
/// Equation   f_lim / max_n (m_n |b_n|)
/// Source     [@morrison2023, eq. 31]; m_n is the row sum of the mass matrix,
///            b_n the position from the centre of mass
/// Limits     Row sums are negative at corners of second-order tetrahedra,
///            which the signed maximum ignores: no bound then.
/// @param lumped_mass N row sums [kg]; @param x_B 3 x N [m]
/// @throws InputError unless the limit [N] is positive; NumericalError if no
/// node has a positive m |b|.
[[nodiscard]] double find_report_force_boundary(const VectorX& lumped_mass,
                                                const Matrix3X& x_B,
                                                double force_limit);

/// The report's displacement-limited boundary on |alpha| + |Omega|^2 [1/s^2].
///
/// Equation   d_lim / max_i (Phi Lambda^-1 Phi^T g)_i, g_(3n+c) = m_n |b_n|
/// Source     [@morrison2023, eq. 32]. Its figures result if m |b| is used for
///            all three components of a node, and the maximum is over
///            components, not over lengths.
/// Limits     g points along (1, 1, 1) at every node, which no inertial force
///            does: an estimate, not a bound.
/// @param Phi 3N x m; @param lambda m; @param lumped_mass N row sums [kg]
/// @param x_B 3 x N [m]
/// @throws InputError unless the limit [m] is positive; NumericalError if
/// all displacements are zero.
[[nodiscard]] double find_report_displacement_boundary(
    const MatrixX& Phi, const VectorX& lambda, const VectorX& lumped_mass,
    const Matrix3X& x_B, double displacement_limit);

/// The constants of the boundaries for a whole mesh: the report's boundaries
/// are the limit over them, and `consistent` gives an InertialForceBound.
/// @param M_s N x N nodal mass, both triangles [kg]; @param x_B 3 x N, relative
/// to the centre of mass [m]; @param Phi 3N x m, without rigid motion
/// @param lambda m, positive
[[nodiscard]] InertialLevers calc_inertial_levers(
    const Eigen::SparseMatrix<double>& M_s, const Matrix3X& x_B,
    const MatrixX& Phi, const VectorX& lambda);

/// Largest nodal inertial force of the undeformed body, over all nodes and all
/// directions of the two vectors.
///
/// Equation   f_n = alpha x g_n + Omega x (Omega x g_n),  g_n = sum_j M_nj b_j;
///            max |f_n| = |g_n| (Omega^2/2 + sqrt(Omega^4/4 + alpha^2))
/// Source     docs/theory/choosing.md; attained, and never above the report's
///            |g_n| (alpha + Omega^2)
/// Limits     the Coriolis force and the deformed lever are neglected, as in
///            the report
class InertialForceBound {
 public:
  /// @param moments 3 x N: M_s x for the consistent mass, or m_n b_n [kg m]
  explicit InertialForceBound(const Matrix3X& moments);
  /// The same for a reduced body, from its `consistent` lever.
  explicit InertialForceBound(const InertialLevers& levers)
      : lever_(levers.consistent) {}

  /// Largest nodal force at alpha [rad/s^2] and Omega [rad/s] [N].
  [[nodiscard]] double calc_force(double alpha, double Omega) const;

  /// `calc_force` over `force_limit` [N]: above 1 [-] the forces that
  /// `uncoupled` neglects may exceed it. @throws InputError unless the limit is
  /// positive.
  [[nodiscard]] double calc_margin(double alpha, double Omega,
                                   double force_limit) const;

 private:
  double lever_;  ///< max |g_n| [kg m]
};

/// How the rotation begins.
enum class Onset {
  slow,    ///< quasi-static: the response follows the inertial force
  sudden,  ///< from rest, about fixed axes, monotonic: up to twice
};

/// Bound on the displacement that inertial forces of the undeformed body cause,
/// over all stored nodes and all directions of the two vectors.
///
/// Equation   u_n = sum_k phi_nk (Omega^2 a.G_k a + alpha e.c_k) / lambda_k,
///            G_k = tr(S1_k) I - (S1_k + S1_k^T)/2, c_k = -int x x phi_k dm;
///            |u_n| <= A_n Omega^2 + B_n alpha for all unit a, e
/// Source     the `one-way` level (docs/theory/equations.md); how A_n and B_n
///            are found is in docs/theory/choosing.md
/// Limits     Displacements of the retained modes and rows, relative to
///            the mean-axis frame, to first order (no centrifugal stiffening,
///            no Coriolis force). In that frame c_k is zero: the Euler force
///            does not deform a free body. Onset::sudden allows for a load
///            that grows from zero and stays, not for one that comes and goes
///            near resonance.
class InertialDisplacementBound {
 public:
  /// @throws InputError for a clamped body, which does not rotate.
  explicit InertialDisplacementBound(const ReducedBody& body,
                                     Onset onset = Onset::slow);

  /// Bound on the largest displacement [m] at alpha [rad/s^2], Omega [rad/s].
  [[nodiscard]] double calc_displacement(double alpha, double Omega) const;

  /// `calc_displacement` over `displacement_limit` [m]: at or below 1 [-]
  /// `uncoupled` neglects no more than that. @throws InputError unless the
  /// limit is positive.
  [[nodiscard]] double calc_margin(double alpha, double Omega,
                                   double displacement_limit) const;

  /// Largest Omega [rad/s] at this alpha with a margin of at most 1: the
  /// boundary curve. Zero if alpha alone exceeds it.
  [[nodiscard]] double find_omega(double alpha,
                                  double displacement_limit) const;

 private:
  VectorX per_omega2_;  ///< A_n [m s^2]
  VectorX per_alpha_;   ///< B_n [m s^2]
};

}  // namespace limber::flexbody
