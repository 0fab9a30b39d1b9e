// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/common/types.hpp"

namespace limber {

/// Axes 1, 2, 3 of a material in the mesh frame: the same everywhere, or
/// radial, tangential and along the axis of a cylinder.
struct MaterialAxes {
  bool is_cylindrical = false;
  /// Columns: the axes. Of a cylinder the last is along its axis, and the
  /// others are the axes of points on it.
  Matrix3 directions = Matrix3::Identity();
  Vector3 point = Vector3::Zero();  ///< on a cylinder's axis [m]

  /// Columns: the axes at x [m].
  [[nodiscard]] Matrix3 at(const Vector3& x) const;
  bool operator==(const MaterialAxes& other) const {
    return is_cylindrical == other.is_cylindrical &&
           directions == other.directions && point == other.point;
  }
};

/// Axis 1 along `first`, axis 2 in the plane of both.
/// @throws InputError if they are parallel, zero or not finite.
[[nodiscard]] MaterialAxes make_axes(const Vector3& first,
                                     const Vector3& second);

/// Radial, tangential and along `direction` through `point` [m].
/// @throws InputError if the direction is zero or not finite.
[[nodiscard]] MaterialAxes make_cylindrical_axes(const Vector3& direction,
                                                 const Vector3& point);

/// Linear elasticity that depends on direction.
struct Anisotropy {
  /// sigma = C gamma in material axes, components (11, 22, 33, 12, 23, 13),
  /// engineering shear strains [Pa].
  Matrix6 C = Matrix6::Zero();
  MaterialAxes axes;

  bool operator==(const Anisotropy& other) const {
    return C == other.C && axes == other.axes;
  }
};

/// Linear elastic material of a solid.
struct SolidMaterial {
  double youngs_modulus = 0.0;  ///< E > 0 [Pa]
  double poisson_ratio = 0.0;   ///< -1 < nu < 0.5 [-]
  double density = 0.0;         ///< rho > 0 [kg/m^3]
  /// Replaces E and nu, which are those of the mean over all directions then
  /// (find_mean_constants).
  std::optional<Anisotropy> anisotropy = std::nullopt;
};

/// Whether stress is the same for every strain.
[[nodiscard]] bool have_same_elasticity(const SolidMaterial& a,
                                        const SolidMaterial& b);

}  // namespace limber
