// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Sparse>
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

/// Adds condensed nodes on the faces of shells and the outlines of beams, which
/// move with their nodes as rigid arms, with the triangles of the closed
/// surface between them, and those of the solids' surface; the skin, of the
/// solids that these nodes make; and the condensed rows of nodes that others
/// lead.
void draw_structure(const PlacedStructure& placed, MatrixModel& model);

}  // namespace limber::fem
