// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "limber/common/material/solid_material.hpp"

namespace limber {

/// Upper triangle of a symmetric 6 x 6 matrix by rows.
using Constants21 = std::array<double, 21>;

/// Nine constants of an orthotropic material. nu_ij is the contraction along j
/// over the extension along i under stress along i: nu_ij / E_i = nu_ji / E_j.
struct EngineeringConstants {
  Vector3 E;   ///< E1, E2, E3 > 0 [Pa]
  Vector3 nu;  ///< nu12, nu13, nu23 [-]
  Vector3 G;   ///< G12, G13, G23 > 0 [Pa]
};

/// C of Anisotropy.
/// @throws InputError with every condition of a positive strain energy that the
/// constants fail: E > 0, G > 0, |nu_ij| < sqrt(E_i / E_j), and 1 - nu12 nu21 -
/// nu23 nu32 - nu13 nu31 - 2 nu21 nu32 nu13 > 0.
/// Source: Jones, Mechanics of Composite Materials, 2nd ed., sec. 2.4
[[nodiscard]] Matrix6 make_orthotropic(const EngineeringConstants& constants);

/// C of Anisotropy from its upper triangle by rows: C11, C12, .., C16, C22, ..
/// @throws InputError if it is not positive definite, naming the first leading
/// block whose determinant is not positive.
[[nodiscard]] Matrix6 make_anisotropic(const Constants21& upper);

/// Conditions of a positive strain energy that C fails; empty if none.
[[nodiscard]] std::vector<std::string> find_inadmissible(const Matrix6& C);

[[nodiscard]] Constants21 list_constants(const Matrix6& C);

/// C of components in the axes in which `directions` (columns) are the material
/// axes.
///
/// Equation   C' = T C T^T, T that of Bond's for stress
/// Source     Auld, Acoustic Fields and Waves in Solids I, sec. 3.D
[[nodiscard]] Matrix6 turn_stiffness(const Matrix6& C,
                                     const Matrix3& directions);

/// C of an isotropic material [Pa].
[[nodiscard]] Matrix6 make_isotropic(double youngs_modulus,
                                     double poisson_ratio);

/// A material with C in these axes; E and nu are those of the mean of C over
/// all directions.
///
/// Source     Voigt's mean: Hill, Proc. Phys. Soc. A 65 (1952)
[[nodiscard]] SolidMaterial make_material(const Matrix6& C,
                                          const MaterialAxes& axes,
                                          double density);

/// C of a material at x [m], components in the mesh frame.
[[nodiscard]] Matrix6 find_stiffness(const SolidMaterial& material,
                                     const Vector3& x);

/// Columns: axes of a material at x [m], mesh frame; the frame's own of an
/// isotropic one.
[[nodiscard]] Matrix3 find_axes(const SolidMaterial& material,
                                const Vector3& x);

}  // namespace limber
