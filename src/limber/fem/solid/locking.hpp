// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/material.hpp"

namespace limber::fem {

/// Modes of a mesh of first-order elements.
struct LinearModes {
  VectorX lambda;  ///< eigenvalues, ascending [rad^2/s^2]
  MatrixX Phi;     ///< 3N x m, M-orthonormal [kg^-1/2]
  MatrixX R;       ///< 3N x 6 rigid modes, likewise; no columns if clamped
  std::vector<int> held;  ///< clamped nodes, sorted
};

/// Rayleigh quotients of the modes after one step of p-refinement: a quadratic
/// function on each edge relaxes the mode, whose values at the nodes stay. They
/// bound the eigenvalues of serendipity elements of second order on the same
/// mesh from above [rad^2/s^2].
///
/// Equation   K_bb c = (lambda M_bn - K_bn) phi, b: edges, n: nodes,
///            b_e = 4 N_i N_j / S on edge i j, S: the sum of N over i, j and
///            the third nodes of triangles at the edge
/// Source     Zienkiewicz, Gago and Kelly, The hierarchical concept in finite
///            element analysis, Computers & Structures 16 (1983)
[[nodiscard]] VectorX calc_refined_eigenvalues(
    const Mesh& mesh, const std::vector<ElasticMaterial>& materials,
    const LinearModes& modes);

}  // namespace limber::fem
