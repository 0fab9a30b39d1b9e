// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/mesh/reference_element.hpp"

namespace limber::fem {

enum class LinearCell { wedge, hexahedron };

/// Nodes and faces of a solid of first order, as Gmsh numbers them, without
/// quadrature: for surfaces of elements other than solids.
[[nodiscard]] ReferenceElement make_linear_cell(LinearCell cell);

}  // namespace limber::fem
