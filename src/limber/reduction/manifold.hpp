// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/progress.hpp"
#include "limber/flexbody/model/quadratic_manifold.hpp"
#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/reduction/meshed_body.hpp"

/// Second-order kinematics of a basis, for level `nonlinear`. Part of
/// limber_reduction.
namespace limber::flexbody {

/// Modes whose rms rotation is this many times their rms strain are paired: 1.5
/// to 2 is a plateau, below 1 axial modes join, 6 loses bending [-].
inline constexpr double kPairedRotation = 1.5;

/// Second-order fields of all pairs of modes, 3N x pairs, and their Q and S2.
///
/// Equation   theta_ij = -K^+ g_ij, less its components along modes of P in the
///            inner product of K; Q_r,ij = c_r,ij / sqrt(lambda_r), halved for
///            i = j (fem/solid/second_order.hpp)
/// Source     modal derivatives [@idelsohn1985]; docs/theory/nonlinear.md
struct ManifoldFields {
  QuadraticManifold tables;  ///< without rows
  MatrixX Theta;             ///< 3N x pairs, mesh frame [kg^-1 m^-1]
};
/// @param Phi 3N x m, all nodes; @param lambda m [rad^2/s^2]
/// @param center mesh frame [m]
/// @throws InputError for more paired modes than QuadraticStrain takes.
[[nodiscard]] ManifoldFields make_manifold(
    const MeshedBody& body, const Recipe& recipe, const MatrixX& Phi,
    const VectorX& lambda, const Vector3& center, const Progress& progress);

/// int theta dm of every pair, 3 x pairs [m^-1]: gravity on the products of
/// modes of a clamped body. @param M_s scalar mass of all nodes [kg]
[[nodiscard]] Matrix3X integrate(const fem::SparseMatrix& M_s,
                                 const MatrixX& Theta);

/// Second-order tables Phi2_B and Psi2_B of an interface.
///
/// Equation   Phi2_ij = sum w theta_ij; A Psi2_ij = axial(G_ij - [psi_i] G_j -
///            [psi_j] G_i + ([psi_i][psi_j] + [psi_j][psi_i]) S / 2), G = sum w
///            u d', S = sum w d d', A = tr(S) I - S, axial(X) that of X - X'
/// Source     the polar rotation R of sum w (d + u) d', R' sum w (d + u) d'
///            symmetric, to second order
void add_second_order(const fem::Mesh& mesh, const Interface& interface,
                      const std::vector<int>& paired, const MatrixX& Phi,
                      const MatrixX& Theta, InterfaceTable& table);

}  // namespace limber::flexbody
