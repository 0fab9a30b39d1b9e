// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/solid_material.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "limber/common/errors.hpp"

namespace limber {
namespace {

std::string list_components(const Vector3& v) {
  return fmt::format("({:g}, {:g}, {:g})", v[0], v[1], v[2]);
}

Vector3 find_direction(const Vector3& v, const char* what) {
  const double length = v.stableNorm();
  if (length > 0.0 && std::isfinite(length)) return v / length;
  throw InputError(
      fmt::format("{} is {}; expected a direction", what, list_components(v)));
}

}  // namespace

Matrix3 MaterialAxes::at(const Vector3& x) const {
  if (!is_cylindrical) return directions;
  const Vector3 along = directions.col(2);
  const Vector3 arm = x - point;
  const Vector3 radial = arm - along.dot(arm) * along;
  constexpr double kOnAxis = 1e-12;  // of the distance from the point
  const double radius = radial.norm();
  if (!(radius > kOnAxis * arm.norm())) return directions;
  Matrix3 axes;
  axes.col(0) = radial / radius;
  axes.col(1) = along.cross(Vector3(axes.col(0)));
  axes.col(2) = along;
  return axes;
}

MaterialAxes make_axes(const Vector3& first, const Vector3& second) {
  constexpr double kParallel = 1e-6;  // sine of the angle
  MaterialAxes axes;
  const Vector3 e1 = find_direction(first, "material axis 1");
  const Vector3 other = find_direction(second, "material axis 2");
  const Vector3 normal = e1.cross(other);
  if (normal.norm() < kParallel) {
    throw InputError(fmt::format(
        "material axes 1 {} and 2 {} are parallel; expected two directions "
        "that span a plane",
        list_components(first), list_components(second)));
  }
  axes.directions.col(0) = e1;
  axes.directions.col(2) = normal.normalized();
  axes.directions.col(1) = Vector3(axes.directions.col(2)).cross(e1);
  return axes;
}

MaterialAxes make_cylindrical_axes(const Vector3& direction,
                                   const Vector3& point) {
  if (!point.allFinite())
    throw InputError(fmt::format("the point on the cylinder's axis is {}",
                                 list_components(point)));
  const Vector3 along = find_direction(direction, "the cylinder's axis");
  const Vector3 radial = along.unitOrthogonal();
  MaterialAxes axes;
  axes.is_cylindrical = true;
  axes.directions << radial, along.cross(radial), along;
  axes.point = point;
  return axes;
}

bool have_same_elasticity(const SolidMaterial& a, const SolidMaterial& b) {
  return a.youngs_modulus == b.youngs_modulus &&
         a.poisson_ratio == b.poisson_ratio && a.anisotropy == b.anisotropy;
}

}  // namespace limber
