// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/fem/structural/shell_element.hpp"

/// What both shells share.
namespace limber::fem {

/// Axes 1, 2 and normal as columns. @throws InputError if `axis` is along
/// the normal
[[nodiscard]] Matrix3 make_surface_axes(const Vector3& normal,
                                        const Vector3& axis);

/// Strains [11, 22, 2 12] of directions from those [rr, ss, 2 rs] of others.
/// @param R of the slopes along 1, 2 by those along r, s
[[nodiscard]] Matrix3 rotate_strain(const Matrix2& R);

/// Two places through the thickness with the laminate's mass and moments of
/// it: z of both, each with half of the mass.
[[nodiscard]] std::array<double, 2> find_mass_places(const Laminate& laminate);

/// Adds the mass of the area around a point of the surface.
/// @param N shape functions there @param normals at the nodes, 3 x nodes
void add_shell_mass(const VectorX& N, const Matrix3X& normals, double area,
                    const Laminate& laminate, StructuralElement& element);

}  // namespace limber::fem
