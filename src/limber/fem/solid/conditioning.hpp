// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/fem/solid/matrices.hpp"

namespace limber::fem {

/// Positions relative to their mean along a body's principal axes, each scaled
/// by its extent to -1 .. 1, so that no coordinate of a thin body is small. 3 x
/// N [-]
[[nodiscard]] Matrix3X scale_positions(const Matrix3X& x);

/// Causes of an ill-conditioned stiffness matrix, as sentences for an error:
/// nearly flat elements and contrasts of material if there are any, else the
/// body's slenderness.
/// @param x positions of the nodes of `matrices` [m]
[[nodiscard]] std::string describe_conditioning(
    const StructuralMatrices& matrices, const Matrix3X& x);

}  // namespace limber::fem
