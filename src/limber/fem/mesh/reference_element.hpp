// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

/// Values of an element type's shape functions at quadrature points.
struct Quadrature {
  VectorX weights;  ///< reference measure [-]
  MatrixX shape;    ///< nodes x points [-]
  std::vector<MatrixX>
      gradients;  ///< per point: 3 x nodes, by reference coordinates [-]
};

/// One Lagrange element type: the data that assembly needs, tabulated once by
/// Gmsh (its points, basis functions and node order).
struct ReferenceElement {
  int gmsh_type = 0;  ///< Gmsh's number of the type
  std::string name;
  int dimension = 0;     ///< [-]
  int order = 0;         ///< polynomial order [-]
  int node_count = 0;    ///< number of nodes
  int corner_count = 0;  ///< number of corners
  MatrixX node_uvw;      ///< 3 x nodes, reference coordinates [-]
  /// nodes x nodes [-]: x * affine_residual is the deviation of an element with
  /// node positions x from an affine image of the reference element.
  MatrixX affine_residual;
  Quadrature straight;   ///< exact mass on parallel-sided elements
  Quadrature curved;     ///< exact mass when the Jacobian varies
  Quadrature stiffness;  ///< exact stiffness on parallel-sided elements
  /// Local nodes of each face, corners first and counter-clockwise seen from
  /// outside; empty below dimension 3.
  std::vector<std::vector<int>> faces;
  std::vector<int> face_corners;  ///< number of corners of each face, 3 or 4
  /// Per face: the solid's functions at the face's quadrature points, with
  /// gradients along the face's two edges from its first corner (2 x nodes).
  std::vector<Quadrature> face_rules;
};

/// Tabulates the type. Needs an open GmshSession.
/// @throws InputError for a solid type that is not supported.
[[nodiscard]] ReferenceElement make_reference_element(int gmsh_type);

}  // namespace limber::fem
