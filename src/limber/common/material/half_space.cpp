// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/material/half_space.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace limber {
namespace {

using Strain = Eigen::Matrix<double, 6, 3>;

// Engineering strain of a displacement's derivative along a: sym(u a^T).
Strain find_strain(const Vector3& a) {
  Strain B = Strain::Zero();
  B.row(0)[0] = a[0];
  B.row(1)[1] = a[1];
  B.row(2)[2] = a[2];
  B.row(3) << a[1], a[0], 0.0;
  B.row(4) << 0.0, a[2], a[1];
  B.row(5) << a[2], 0.0, a[0];
  return B;
}

}  // namespace

SurfaceCompliance find_surface_compliance(const Matrix6& C,
                                          const Vector3& normal) {
  // The integrands are periodic and smooth: the trapezoidal rule converges
  // faster than any power of the number of points.
  constexpr int kDirections = 24;
  constexpr int kTurns = 48;
  const Vector3 u = normal.unitOrthogonal();
  const Vector3 v = normal.cross(u);
  const auto at = [](int i, int count) { return std::numbers::pi * i / count; };
  SurfaceCompliance mean;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = at(i, kDirections);
    const Vector3 t = std::cos(angle) * u + std::sin(angle) * v;
    const Vector3 across = normal.cross(t);
    Matrix3 L = Matrix3::Zero();
    for (int k = 0; k < kTurns; ++k) {
      const double w = at(k, kTurns);
      const Strain m = find_strain(std::cos(w) * across + std::sin(w) * normal);
      const Strain n =
          find_strain(-std::sin(w) * across + std::cos(w) * normal);
      const Matrix3 mn = m.transpose() * C * n;
      const Matrix3 nn = n.transpose() * C * n;
      L += m.transpose() * C * m - mn * nn.inverse() * mn.transpose();
    }
    const Matrix3 compliance = (L / kTurns).inverse();
    mean.normal += normal.dot(compliance * normal) / kDirections;
    mean.tangential +=
        0.5 * (t.dot(compliance * t) + across.dot(compliance * across)) /
        kDirections;
  }
  return mean;
}

SolidMaterial find_isotropic_surface(const SurfaceCompliance& compliance) {
  const double ratio = compliance.tangential / compliance.normal;
  const double nu =
      ratio > 0.75
          ? std::clamp((2.0 * ratio - 2.0) / (2.0 * ratio - 1.0), -0.99, 0.49)
          : -0.99;
  SolidMaterial material;
  material.poisson_ratio = nu;
  material.youngs_modulus = 2.0 * (1.0 - nu * nu) / compliance.normal;
  return material;
}

}  // namespace limber
