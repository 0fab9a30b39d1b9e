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
};

}  // namespace limber::fem
