// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/solid/material.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// The solid elements of a deck of beams and shells; none: an empty mesh.
struct StructureSolids {
  Mesh mesh;  ///< in SI units; tags are numbers of the deck's nodes
  std::vector<ElasticMaterial> materials;  ///< by region, in SI units
  double unit = 1.0;                       ///< of the deck's lengths [m]
};

/// By the mesher, as those of a deck of solids alone, which may be in several
/// parts here. @param force newtons per unit of force of the deck
/// @throws InputError as read_mesh and assign_materials
[[nodiscard]] StructureSolids read_structure_solids(const Structure& structure,
                                                    double unit,
                                                    double force = 1.0);

}  // namespace limber::fem
