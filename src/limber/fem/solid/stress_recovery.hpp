// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/hyperelastic.hpp"
#include "limber/fem/solid/material.hpp"

/// Nodal stress of displacement fields, linear elasticity.
namespace limber::fem {

/// Values at an element's nodes from those at quadrature points: nodes x points
/// [-].
///
/// Equation   least squares, weighted by the rule, over polynomials in the
///            reference coordinates of degree p - 1: complete for tetrahedra
///            and pyramids, in each direction for hexahedra, in the triangle
///            times along the axis for prisms
/// Source     local smoothing [@hinton1974]: on the bricks' Gauss rules it goes
///            through the points of superconvergence [@barlow1976]
[[nodiscard]] MatrixX make_stress_fit(const ReferenceElement& element,
                                      const Quadrature& rule);

/// Materials that differ in stress: those of the same elasticity are merged.
struct IndexedMaterials {
  std::vector<ElasticMaterial> constants;
  std::vector<int> of_region;  ///< index into `constants`
};
/// @param materials one per region
[[nodiscard]] IndexedMaterials index_materials(
    const std::vector<ElasticMaterial>& materials);

/// Second-order fields of pairs i <= j of some fields of Phi, in the order 11,
/// 12, .., 1P, 22, ...
struct PairedFields {
  std::vector<int> paired;  ///< columns of Phi, increasing
  MatrixX Theta;            ///< 3N x pairs [the fields' unit squared / m]
  Elasticity law = Elasticity::st_venant_kirchhoff;
};

/// Stress of k fields at nodes, with a point for each material of a node.
struct NodalStress {
  std::vector<int> nodes;      ///< p, increasing
  std::vector<int> materials;  ///< p: index into `constants`
  /// 6 (k + pairs) x p: components (xx, yy, zz, xy, yz, xz) of the first field,
  /// then of the second, .., then of the pairs [Pa per unit of the field]
  MatrixX stress;
  /// k x k: int (s* - s) C^-1 (s* - s) dV, s* interpolated from the nodes, s
  /// the element's own [J per unit of the fields].
  MatrixX averaging;
  std::vector<ElasticMaterial> constants;  ///< of distinct elasticity
};

/// Stress at nodes: Hooke's law at the quadrature points of the stiffness,
/// fitted over each element, mean of the elements of one material at a node.
///
/// Equation   sigma = lambda tr(e) I + 2 mu e, or C e with C at the point, e =
///            sym(grad u); of a pair
///            e = sym(grad theta_ij) + sym(grad phi_i' grad phi_j): Green's
///            strain of Phi q + 1/2 Theta q q to second order, and
///            calc_stress_curvature() of phi_i and phi_j, so that sigma is the
///            second Piola-Kirchhoff stress to second order
/// Source     [@hinton1974]; averaging's error: [@zienkiewicz1987]
/// @param materials one per region of the mesh
/// @param Phi 3N x k displacement fields
[[nodiscard]] NodalStress recover_stress(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const MatrixX& Phi, const PairedFields& second = {});

}  // namespace limber::fem
