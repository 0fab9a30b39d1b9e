// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

/// A part of an element's mass: it moves by N q.
struct MassPoint {
  double mass = 0.0;
  MatrixX N;  ///< 3 x unknowns
};

/// An element of nodes with six unknowns each: displacement and rotation along
/// and about the axes of the model. Rigid motions of all nodes are rigid
/// motions of all its mass points, and meet no stiffness, to roundoff.
struct StructuralElement {
  MatrixX K;  ///< 6 n x 6 n stiffness
  /// The field of its mass: M = sum m N^T N.
  std::vector<MassPoint> points;
  /// Of a shell at each node: 8 x 6 n, strains [11, 22, 2 12] of the surface,
  /// curvatures [11, 22, 2 12], transverse shear [13, 23] in `axes`.
  std::vector<MatrixX> strains;
  std::vector<Matrix3> axes;  ///< at each node: 1, 2, normal as columns
  /// Of a beam: 12 x 12, N, Vy, Vz, T, My, Mz at its first, then its second
  /// end, of the part beyond x on that before it, about the centroid.
  MatrixX section_forces;
};

/// An element and the nodes of its unknowns.
struct PlacedElement {
  StructuralElement element;
  std::vector<int> nodes;
};

}  // namespace limber::fem
