// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "fem/matrices.hpp"

namespace limber::fem {

/// Positions from their mean along a body's principal axes, each over its own
/// extent: -1 .. 1, so that no coordinate of a thin body is small. 3 x N [-]
[[nodiscard]] Matrix3X scale_positions(const Matrix3X& x);

/// What makes a stiffness matrix ill-conditioned, as sentences for an error:
/// nearly flat elements and contrasts of material only where there are such,
/// else the body's slenderness.
/// @param x positions of the nodes of `matrices` [m]
[[nodiscard]] std::string describe_conditioning(
    const StructuralMatrices& matrices, const Matrix3X& x);

}  // namespace limber::fem
