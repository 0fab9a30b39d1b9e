// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/structural/structure_solids.hpp"

namespace limber::fem {

struct AssembledStructure {
  MatrixModel model;
  double mass = 0.0;  ///< of all elements, in the file's unit
};

/// Stiffness, mass and second moments of the mass (exact for the elements'
/// fields). Nodes that nothing leads have six rows, and three where they are of
/// solids alone. Nodes without an element are left out.
/// @throws InputError with the place of what is wrong: an element's shape, a
/// node that two rigid elements lead, a mass on a node that nothing holds; and
/// for parts that nothing joins
[[nodiscard]] AssembledStructure assemble_structure(
    const Structure& structure, const StructureSolids& solids = {});

}  // namespace limber::fem
