// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/material/solid_material.hpp"

namespace limber {

/// Compliances of a half-space under point forces on its surface, mean over
/// the directions in the surface: (1 - nu) / mu along the normal and (2 - nu) /
/// (2 mu) along the surface of an isotropic one [1/Pa].
///
/// Equation   the surface compliance of a line of forces along t is L(t)^-1,
///            L = 1/pi int_0^pi ((mm) - (mn) (nn)^-1 (nm)) dw, m and n turning
///            about t; a point force: its mean over t
/// Source     Barnett and Lothe, Phys. Norv. 7 (1973); the indentation modulus
///            is 2 / normal: Vlassak and Nix, J. Mech. Phys. Solids 42 (1994)
struct SurfaceCompliance {
  double normal = 0.0;
  double tangential = 0.0;
};
/// @param C stiffness, components in the axes of `normal` [Pa]
/// @param normal unit vector
[[nodiscard]] SurfaceCompliance find_surface_compliance(const Matrix6& C,
                                                        const Vector3& normal);

/// The isotropic material of the same compliances; nu is kept within (-0.99,
/// 0.49), and then only the normal one is the same. Without density.
[[nodiscard]] SolidMaterial find_isotropic_surface(
    const SurfaceCompliance& compliance);

}  // namespace limber
