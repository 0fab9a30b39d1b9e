// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

struct AssembledStructure {
  MatrixModel model;
  double mass = 0.0;  ///< of all elements, in the file's unit
};

/// Stiffness, mass and second moments of the mass (exact for the elements'
/// fields), six rows for each node that is not led by a spider. Nodes without
/// an element are left out.
/// @throws InputError with the place of what is wrong: an element's shape, a
/// node that two spiders lead, a mass on a node that nothing holds
[[nodiscard]] AssembledStructure assemble_structure(const Structure& structure);

}  // namespace limber::fem
