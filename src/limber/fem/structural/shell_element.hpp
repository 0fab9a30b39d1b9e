// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/fem/structural/laminate.hpp"
#include "limber/fem/structural/structural_element.hpp"

namespace limber::fem {

/// A shell between three or four nodes, counterclockwise about its normal.
struct ShellShape {
  Matrix3X x;  ///< 3 x 3 or 3 x 4, positions
  /// Axis 1 of the laminate, by its part in the surface.
  Vector3 axis = Vector3::UnitX();
};

/// Stiffness of the rotation about the normal, of A_66: any number from 1e-6 to
/// 1e-1 gives the same frequencies to 1e-4 in the tests.
inline constexpr double kDrilling = 1e-3;

/// Quadrilateral of four nodes, flat or warped.
///
/// Equation   u = sum N_i (u_i + z theta_i x n_i), n_i the normal at node i;
///            strains linear in z; transverse shear from the middles of the
///            edges; four enhanced membrane strains; k A_66 (theta_n - curl u /
///            2)^2 for the rotation about the normal
/// Source     MITC4: Dvorkin, Bathe, A continuum mechanics based four-node
/// shell
///            element, Eng. Comput. 1 (1984) 77-88; membrane: Simo, Rifai, A
///            class of mixed assumed strain methods, Int. J. Numer. Meth. Eng.
///            29 (1990) 1595-1638; rotation about the normal: Hughes, Brezzi,
///            On drilling degrees of freedom, Comput. Meth. Appl. Mech. Eng. 72
///            (1989) 105-121
/// @returns 24 x 24
/// @throws InputError, without its place, for one that is folded or has no area
/// at a corner, or `axis` along the normal
[[nodiscard]] StructuralElement make_quad_shell(const ShellShape& shape,
                                                const Laminate& laminate);

/// Flat triangle of three nodes.
///
/// Equation   membrane with rotations about the normal (optimal parameters);
///            rotations quadratic along the sides; transverse shear constant
///            along each of them. In the limit of a thin shell the bending is
///            that of the discrete Kirchhoff triangle (DKT): it does not lock.
///            Laminates with B: N = A (e + A^-1 B k') with k' the mean
///            curvature, M by D - B A^-1 B: additional membrane strains -A^-1 B
///            (k - k') of mean zero, which the varying curvature would stretch
///            otherwise
/// Source     membrane: Felippa, A study of optimal membrane triangles with
///            drilling freedoms, Comput. Meth. Appl. Mech. Eng. 192 (2003)
///            2125-2168; bending: Katili, A new discrete Kirchhoff-Mindlin
///            element based on Mindlin-Reissner plate theory and assumed shear
///            strain fields, part I (DKMT), Int. J. Numer. Meth. Eng. 36 (1993)
///            1859-1883
/// @returns 18 x 18
/// @throws InputError, without its place, for one without area, or `axis` along
/// the normal
[[nodiscard]] StructuralElement make_triangle_shell(const ShellShape& shape,
                                                    const Laminate& laminate);

}  // namespace limber::fem
