// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/shell_axes.hpp"

#include <cmath>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"

namespace limber::fem {

Matrix3 make_surface_axes(const Vector3& normal, const Vector3& axis) {
  constexpr double kParallel = 1e-6;
  const Vector3 along = axis - normal * normal.dot(axis);
  if (!(along.norm() > kParallel * axis.norm()))
    throw InputError(
        "axis 1 of its material is along the normal. Expected one in the "
        "surface.");
  Matrix3 axes;
  axes.col(0) = along.normalized();
  axes.col(1) = normal.cross(axes.col(0));
  axes.col(2) = normal;
  return axes;
}

Matrix3 rotate_strain(const Matrix2& R) {
  const double a = R(0, 0);
  const double b = R(0, 1);
  const double c = R(1, 0);
  const double d = R(1, 1);
  Matrix3 T;
  T << a * a, b * b, a * b,  //
      c * c, d * d, c * d,   //
      2.0 * a * c, 2.0 * b * d, a * d + b * c;
  return T;
}

std::array<double, 2> find_mass_places(const Laminate& laminate) {
  if (!(laminate.mass > 0.0)) return {0.0, 0.0};
  const double z = laminate.first_mass / laminate.mass;
  const double r =
      std::sqrt(std::max(laminate.second_mass / laminate.mass - z * z, 0.0));
  return {z - r, z + r};
}

void add_shell_mass(const VectorX& N, const Matrix3X& normals, double area,
                    const Laminate& laminate, StructuralElement& element) {
  if (!(laminate.mass > 0.0)) return;
  for (const double z : find_mass_places(laminate)) {
    MassPoint point{0.5 * laminate.mass * area, MatrixX(3, 6 * N.size())};
    for (Eigen::Index i = 0; i < N.size(); ++i) {
      point.N.middleCols<3>(6 * i) = N[i] * Matrix3::Identity();
      point.N.middleCols<3>(6 * i + 3) =
          -N[i] * z * skew(Vector3(normals.col(i)));
    }
    element.points.push_back(std::move(point));
  }
}

}  // namespace limber::fem
