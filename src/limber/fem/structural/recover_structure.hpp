// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/structural/draw_structure.hpp"

namespace limber::fem {

/// Stress at the nodes of shells, bottom, middle and top or by ply, on the
/// outlines of beams, and at the nodes of solids; section forces at the ends of
/// beams.
///
/// Equation   shells: strains at a node times the ply's stiffness; transverse
///            shear stress by equilibrium (laminate.hpp). Elements of one
///            section around a node whose normals, and fibres, differ by at
///            most 30 degrees have one stress, turned to the mean normal. Of
///            quadrilaterals their mean, each extrapolated from its points of
///            integration; where triangles are among them, by
///            find_linear_fit() through the middles of the elements around
///            the node, of a node at an edge the mean of what those of its
///            neighbours inside give there. Beams: N / A + My z / Iy
///            - Mz y / Iz, shear stress of Vy and Vz by the section's points,
///            and the largest of torsion, T / W_t, along the outline
/// Limits     no points on beams without dimensions (BeamSection::points)
/// @param structure, solids, copied @param solid_nodes of their mesh in the
/// structure
/// @param places of the structure's nodes in the model
/// @param map six unknowns of each node by the model's rows
[[nodiscard]] RecoverSections make_recovery(const Structure& structure,
                                            const StructureSolids& solids,
                                            std::vector<int> solid_nodes,
                                            std::vector<int> places,
                                            const NodeMap& map,
                                            DrawnStructure drawn);

}  // namespace limber::fem
