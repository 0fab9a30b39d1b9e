// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/linalg/sparse_matrix.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Surface matrix of the nodes: N x N, both triangles [m^2]. Times a drag
/// coefficient per area it is the scalar damping matrix of the surface.
///
/// Equation   S_ab = int N_a N_b dA over the boundary faces
[[nodiscard]] SparseMatrix assemble_surface_matrix(const Mesh& mesh);

/// Largest values over all quadrature points of the symmetric and skew parts of
/// the displacement gradient; both zero for a translation.
struct LargestGradient {
  double strain = 0.0;    ///< principal value of its symmetric part [-]
  double rotation = 0.0;  ///< of its skew part [rad]
};
/// @param u 3 x N [m]
[[nodiscard]] LargestGradient calc_largest_gradient(const Mesh& mesh,
                                                    const Matrix3X& u);

}  // namespace limber::fem
