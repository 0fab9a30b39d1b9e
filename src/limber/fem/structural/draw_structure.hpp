// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
#include <array>
#include <vector>

#include "limber/fem/structural/node_motions.hpp"
#include "limber/fem/structural/structure_solids.hpp"

namespace limber::fem {

/// The six unknowns of each node of a structure by the rows of its matrices.
using NodeMap = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// What is drawn.
struct PlacedStructure {
  const Structure& structure;
  const StructureSolids& solids;
  const NodeMotions& motions;
  const std::vector<int>& places;       ///< of nodes in the model; -1: left out
  const std::vector<int>& solid_nodes;  ///< of the solids' mesh
  const NodeMap& map;
};

/// Cosine of the largest angle between normals, or fibres, that are taken as
/// one: 30 degrees.
inline constexpr double kSameDirection = 0.866;

/// A node of a shell as its faces have it: elements around it whose normals
/// differ by at most 30 degrees share one, others beyond a fold have their own.
struct FaceNode {
  int node = -1;   ///< of the structure
  Vector3 normal;  ///< of the first element
  Vector3 sum;     ///< of the normals of all
  double bottom = 0.0;
  double top = 0.0;
  std::array<int, 2> drawn = {-1, -1};  ///< nodes of the model below and above
};

/// What was drawn.
struct DrawnStructure {
  std::vector<FaceNode> faces;
  std::vector<std::vector<int>> corners;  ///< of each shell: indices of faces
  /// Of each beam, at both ends: nodes of the model, in list_outline()'s order.
  std::vector<std::array<std::vector<int>, 2>> outlines;
};

/// Points y, z of the outline, counterclockwise about x; of a section without
/// dimensions those of the rectangle of its moments.
[[nodiscard]] std::vector<std::array<double, 2>> list_outline(
    const BeamSection& section);

/// Adds condensed nodes on the faces of shells and the outlines of beams, which
/// move with their nodes as rigid arms, with the triangles of the closed
/// surface between them, and those of the solids' surface; the whole surface,
/// of the solids that these nodes make; and the condensed rows of nodes that
/// others lead.
DrawnStructure draw_structure(const PlacedStructure& placed,
                              MatrixModel& model);

}  // namespace limber::fem
