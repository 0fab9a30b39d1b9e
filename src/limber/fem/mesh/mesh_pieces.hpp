// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/mesh/node_weights.hpp"

namespace limber::fem {

/// A part of a mesh, as a separate mesh.
///
/// Its surface is part of the whole's: faces shared with other pieces are not
/// in boundary_faces. Tags of nodes and elements and the list of volume groups
/// are those of the whole; groups contain their elements in the piece, and are
/// omitted if there are none.
struct MeshPiece {
  Mesh mesh;
  std::vector<int> nodes;  ///< index in the whole mesh of each node, sorted

  /// Index in the piece of a node of the whole mesh; -1 if it has none.
  [[nodiscard]] int find(int node) const;
};

/// A connected face between two pieces.
struct MeshCut {
  int first = 0;            ///< piece, the lower number
  int second = 0;           ///< piece
  WeightedNodes selection;  ///< nodes of the whole mesh, by weigh_cut()
};

/// A mesh cut into pieces.
struct CutMesh {
  std::vector<MeshPiece> pieces;
  std::vector<MeshCut> cuts;
};

/// The piece of every element, block by block.
using ElementLabels = std::vector<int>;

/// @param labels one per element, from 0 on
/// @throws InputError if a piece's elements do not form one part joined by
/// faces.
[[nodiscard]] CutMesh separate(const Mesh& mesh, const ElementLabels& labels);

}  // namespace limber::fem
