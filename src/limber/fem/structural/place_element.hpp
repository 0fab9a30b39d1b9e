// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/structural/structural_element.hpp"
#include "limber/fem/structural/structure.hpp"

namespace limber::fem {

/// Elements of a structure.
/// @throws InputError with the element's place
[[nodiscard]] StructuralElement make_element(const Structure& structure,
                                             const StructureBeam& beam);
[[nodiscard]] StructuralElement make_element(const Structure& structure,
                                             const StructureShell& shell);

/// The laminate of a shell at its offset.
[[nodiscard]] Laminate find_laminate(const Structure& structure,
                                     const StructureShell& shell);

/// Axes x, y, z of a beam's section as columns.
[[nodiscard]] Matrix3 find_axes(const Structure& structure,
                                const StructureBeam& beam);

}  // namespace limber::fem
