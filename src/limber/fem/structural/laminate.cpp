// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/laminate.hpp"

#include <array>
#include <cmath>

namespace limber::fem {
namespace {

/// Plane stress in the shell's axes.
Matrix3 calc_plane_stress(const Ply& ply) {
  const PlyMaterial& m = ply.material;
  const double d = 1.0 - m.nu_12 * m.nu_12 * m.E_2 / m.E_1;
  Matrix3 Q;
  Q << m.E_1 / d, m.nu_12 * m.E_2 / d, 0.0,  //
      m.nu_12 * m.E_2 / d, m.E_2 / d, 0.0,   //
      0.0, 0.0, m.G_12;
  const double c = std::cos(ply.angle);
  const double s = std::sin(ply.angle);
  Matrix3 T;                 // strains in the ply's axes
  T << c * c, s * s, c * s,  //
      s * s, c * c, -c * s,  //
      -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  return T.transpose() * Q * T;
}

Matrix2 calc_shear_flexibility(const Ply& ply) {
  const double c = std::cos(ply.angle);
  const double s = std::sin(ply.angle);
  Matrix2 T;
  T << c, s, -s, c;
  return T.transpose() *
         Eigen::Vector2d(1.0 / ply.material.G_13, 1.0 / ply.material.G_23)
             .asDiagonal() *
         T;
}

/// S by the shear stress of cylindrical bending.
Matrix2 calc_shear(const std::vector<Ply>& plies, const Laminate& laminate) {
  // Exact for polynomials of degree 5.
  constexpr std::array<std::array<double, 2>, 3> kGauss = {
      {{0.1127016653792583, 5.0 / 18.0},
       {0.5, 8.0 / 18.0},
       {0.8872983346207417, 5.0 / 18.0}}};
  Eigen::Vector2d neutral;
  Eigen::Vector2d bending;
  for (int a = 0; a < 2; ++a) {
    neutral[a] = laminate.B(a, a) / laminate.A(a, a);
    bending[a] = laminate.D(a, a) - laminate.B(a, a) * neutral[a];
  }
  Matrix2 flexibility = Matrix2::Zero();
  Eigen::Vector2d below = Eigen::Vector2d::Zero();  // of f
  double z = laminate.bottom;
  for (const Ply& ply : plies) {
    const Matrix3 Q = calc_plane_stress(ply);
    const Matrix2 G = calc_shear_flexibility(ply);
    const auto stress = [&](double end) {
      Eigen::Vector2d f = below;
      for (int a = 0; a < 2; ++a)
        f[a] += Q(a, a) * (0.5 * (end * end - z * z) - neutral[a] * (end - z)) /
                bending[a];
      return f;
    };
    for (const auto& [s, weight] : kGauss) {
      const Eigen::Vector2d f = stress(z + s * ply.thickness);
      flexibility +=
          weight * ply.thickness * (f * f.transpose()).cwiseProduct(G);
    }
    below = stress(z + ply.thickness);
    z += ply.thickness;
  }
  return flexibility.inverse();
}

}  // namespace

PlyMaterial make_isotropic(double E, double nu, double density) {
  const double G = 0.5 * E / (1.0 + nu);
  return {E, E, nu, G, G, G, density};
}

Laminate make_laminate(const std::vector<Ply>& plies, double bottom) {
  Laminate laminate;
  laminate.bottom = bottom;
  double z = bottom;
  for (const Ply& ply : plies) {
    const double end = z + ply.thickness;
    const double first = 0.5 * (end * end - z * z);
    const double second = (end * end * end - z * z * z) / 3.0;
    const Matrix3 Q = calc_plane_stress(ply);
    laminate.A += Q * ply.thickness;
    laminate.B += Q * first;
    laminate.D += Q * second;
    laminate.mass += ply.material.density * ply.thickness;
    laminate.first_mass += ply.material.density * first;
    laminate.second_mass += ply.material.density * second;
    z = end;
  }
  laminate.top = z;
  if (!plies.empty()) laminate.outer = plies.back().material;
  laminate.S = calc_shear(plies, laminate);
  return laminate;
}

Laminate shift_laminate(const Laminate& laminate, double offset) {
  if (offset == 0.0) return laminate;
  Laminate moved = laminate;
  moved.B += offset * laminate.A;
  moved.D += 2.0 * offset * laminate.B + offset * offset * laminate.A;
  moved.first_mass += offset * laminate.mass;
  moved.second_mass +=
      2.0 * offset * laminate.first_mass + offset * offset * laminate.mass;
  moved.bottom += offset;
  moved.top += offset;
  return moved;
}

}  // namespace limber::fem
