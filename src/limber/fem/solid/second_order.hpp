// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hyperelastic.hpp"
#include "limber/fem/solid/material.hpp"

/// Terms of second order of a mesh in large displacement, for bases of modes.
namespace limber::fem {

/// Second derivatives of the internal forces and of the strain energy at rest,
/// for every pair i <= j of p fields in the order 11, 12, .., 1p, 22, ..
///
/// Equation   g_ij = int (C : sym(H_i' H_j) + H_i S_j + H_j S_i + A_ij) grad N
///            dV, c_r,ij = int (S_r : H_i' H_j + A_ij : sym H_r / 3) dV, S_i =
///            C : sym H_i, A_ij of calc_stress_curvature()
/// Source     the internal force int F S(E) grad N of a hyperelastic solid, E =
///            sym H + H' H / 2, differentiated twice at u = 0; int A_ij : sym
///            H_r is symmetric in i, j and r
/// Limits     A_ij: isotropic materials only
struct SecondOrderTerms {
  MatrixX loads;   ///< 3N x p (p + 1) / 2: g [N for fields in m]
  MatrixX strain;  ///< p x p (p + 1) / 2: c, row r [J for fields in m]
  MatrixX scale;   ///< the same with int |S_r| |H_i| |H_j| dV: bounds c [as c]
};
/// @param materials one per region of the mesh
/// @param Phi 3N x p
[[nodiscard]] SecondOrderTerms calc_second_order(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    Elasticity law, const MatrixX& Phi);

/// Root-mean-square rotation and strain of nodal fields.
///
/// Equation   sqrt(int |skew H|^2 / 2 dV / V), sqrt(int |sym H|^2 dV / V)
struct MeanDeformation {
  VectorX rotation;  ///< k [rad per unit of the field]
  VectorX strain;    ///< k [per unit of the field]
};
/// @param Phi 3N x k nodal fields [any unit]
[[nodiscard]] MeanDeformation find_mean_deformation(const Mesh& mesh,
                                                    const MatrixX& Phi);

/// Rotation over strain of each field.
///
/// Equation   sqrt(int |skew H|^2 dV / int |sym H|^2 dV), H = grad phi
/// @returns k [-]; infinite for a rigid rotation, NaN for no motion at all
[[nodiscard]] VectorX find_rotation_ratios(const MeanDeformation& mean);

/// Energies of the second-order strains E_ij = sym(grad theta_ij) + sym(H_i'
/// H_j) of pairs: the part of Green's strain on the manifold that is not linear
/// in the modes.
///
/// Equation   W_kl = int E_k : C : E_l dV
/// @param Phi 3N x p; @param Theta 3N x p (p + 1) / 2, pairs as above
/// @param of places of pairs, increasing
/// @returns rows and columns those of `of` [J for fields in m]
[[nodiscard]] MatrixX calc_pair_energy(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const MatrixX& Phi, const MatrixX& Theta, const std::vector<int>& of);

/// Its diagonal for all pairs, at a cost proportional to their number.
[[nodiscard]] VectorX calc_pair_energies(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const MatrixX& Phi, const MatrixX& Theta);

}  // namespace limber::fem
