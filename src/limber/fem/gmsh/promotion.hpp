// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/gmsh/raw_block.hpp"

namespace limber::fem {

/// Makes a finished mesh of first order one of serendipity elements of second
/// order: a node in the middle of each edge, with a tag of its own, also in the
/// groups. Edges stay straight. Leaves a mesh of second order as it is.
/// @throws InputError for another order, or for elements of both
void promote_to_second_order(Mesh& mesh);

}  // namespace limber::fem
