// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/types.hpp"

namespace limber::fem {

/// Values of an element type's shape functions at quadrature points.
struct Quadrature {
  VectorX weights;                 ///< reference measure [-]
  MatrixX shape;                   ///< nodes x points
  std::vector<MatrixX> gradients;  ///< per point: 3 x nodes, reference space
};

/// One Lagrange element type: what assembly needs to know of it, tabulated
/// once by Gmsh (its own points, basis functions and node order).
struct ReferenceElement {
  int gmsh_type = 0;
  std::string name;
  int dimension = 0;
  int order = 0;
  int node_count = 0;
  int corner_count = 0;
  MatrixX node_uvw;  ///< 3 x nodes, reference coordinates [-]
  /// nodes x nodes: x * affine_residual is what keeps the element with node
  /// positions x from being an affine image of the reference element.
  MatrixX affine_residual;
  Quadrature straight;   ///< exact mass on parallel-sided elements
  Quadrature curved;     ///< exact mass when the Jacobian varies
  Quadrature stiffness;  ///< exact stiffness on parallel-sided elements
  /// Local nodes of each face, corners first and counter-clockwise seen from
  /// outside; empty below dimension 3.
  std::vector<std::vector<int>> faces;
  std::vector<int> face_corners;  ///< 3 or 4, per face
  /// Per face: the solid's functions at the face's quadrature points, with
  /// gradients along the face's two edges from its first corner (2 x nodes).
  std::vector<Quadrature> face_rules;
};

/// Tabulates the type. Needs a live GmshSession.
/// @throws InputError for a solid type that is not supported.
[[nodiscard]] ReferenceElement make_reference_element(int gmsh_type);

}  // namespace limber::fem
