// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "limber/common/material/solid_material.hpp"

namespace limber {

/// A material as a user states it: isotropic (one E and nu), orthotropic (three
/// E, nu and G) or anisotropic (21 constants).
struct StatedMaterial {
  std::vector<double> youngs_modulus;  ///< E, or E1, E2, E3 [Pa]
  std::vector<double> poisson_ratio;   ///< nu, or nu12, nu13, nu23 [-]
  std::vector<double> shear_modulus;   ///< empty, or G12, G13, G23 [Pa]
  /// Empty, or C11, C12, .., C16, C22, .. in the order of Anisotropy [Pa]
  std::vector<double> stiffness;
  double density = 0.0;                   ///< [kg/m^3]
  std::optional<Vector3> axis_1;          ///< constant axes; with axis_2
  std::optional<Vector3> axis_2;          ///< in the plane of axes 1 and 2
  std::optional<Vector3> cylinder_axis;   ///< in place of them
  std::optional<Vector3> cylinder_point;  ///< on that axis; the origin [m]

  [[nodiscard]] bool is_empty() const;
  [[nodiscard]] bool is_anisotropic() const {
    return !shear_modulus.empty() || !stiffness.empty();
  }
};

/// @throws InputError with all problems: numbers of constants, their ranges,
/// conditions of a positive strain energy, and axes.
[[nodiscard]] SolidMaterial make_material(const StatedMaterial& stated);

}  // namespace limber
