// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// How a node moves: with the six rows from `row` on, at `arm` from theirs.
struct NodeMotion {
  int row = -1;
  Vector3 arm = Vector3::Zero();
};

/// Adds condensed nodes on the faces of shells and the outlines of beams, which
/// move with their nodes as rigid arms, with the triangles of the closed
/// surface between them; and the condensed rows of nodes that spiders lead.
/// @param places of the structure's nodes in the model, -1 where left out
/// @param motions of the structure's nodes
void draw_structure(const Structure& structure, const std::vector<int>& places,
                    const std::vector<NodeMotion>& motions, MatrixModel& model);

}  // namespace limber::fem
