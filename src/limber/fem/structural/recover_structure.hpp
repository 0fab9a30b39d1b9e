// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/fem/structural/draw_structure.hpp"

namespace limber::fem {

/// Stress at the nodes of shells, bottom, middle and top or by ply, and on the
/// outlines of beams; section forces at the ends of beams.
///
/// Equation   shells: strains at the points of integration, extrapolated to
///            the nodes, times the ply's stiffness; transverse shear stress by
///            equilibrium (laminate.hpp); mean of the elements of one section
///            around a node whose normals, and fibres, differ by at most 30
///            degrees, each turned to the mean normal. Beams: N / A + My z / Iy
///            - Mz y / Iz, and the largest shear stress of torsion, T / W_t,
///            at all points of the outline
/// Limits     no shear stress of a beam's shear forces; no points on beams
///            without dimensions (BeamSection::torsion_modulus 0)
/// @param structure, copied
/// @param places of the structure's nodes in the model
/// @param map six unknowns of each node by the model's rows
[[nodiscard]] RecoverSections make_recovery(const Structure& structure,
                                            std::vector<int> places,
                                            const NodeMap& map,
                                            DrawnStructure drawn);

}  // namespace limber::fem
