// SPDX-License-Identifier: BSD-3-Clause
#include "limber/fem/structural/laminate.hpp"

#include <array>
#include <cmath>

namespace limber::fem {
namespace {

/// Of orthotropic constants, in the ply's axes.
Matrix3 calc_own_plane_stress(const PlyMaterial& m) {
  if (!m.plane_stress.isZero(0.0)) return m.plane_stress;
  const double d = 1.0 - m.nu_12 * m.nu_12 * m.E_2 / m.E_1;
  Matrix3 Q;
  Q << m.E_1 / d, m.nu_12 * m.E_2 / d, 0.0,  //
      m.nu_12 * m.E_2 / d, m.E_2 / d, 0.0,   //
      0.0, 0.0, m.G_12;
  return Q;
}

/// Plane stress in the shell's axes.
Matrix3 calc_plane_stress(const Ply& ply) {
  const double c = std::cos(ply.angle);
  const double s = std::sin(ply.angle);
  Matrix3 T;                 // strains in the ply's axes
  T << c * c, s * s, c * s,  //
      s * s, c * c, -c * s,  //
      -2.0 * c * s, 2.0 * c * s, c * c - s * s;
  return T.transpose() * calc_own_plane_stress(ply.material) * T;
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

/// Shear stress [13, 23] of unit shear forces along axes 1 and 2, as
/// equilibrium gives it in cylindrical bending.
class ShearProfile {
 public:
  ShearProfile(const std::vector<Ply>& plies, const Laminate& laminate) {
    for (int a = 0; a < 2; ++a) {
      neutral_[a] = laminate.B(a, a) / laminate.A(a, a);
      bending_[a] = laminate.D(a, a) - laminate.B(a, a) * neutral_[a];
    }
    starts_.push_back(
        {laminate.bottom, Eigen::Vector2d::Zero(), Matrix3::Zero()});
    for (const Ply& ply : plies) {
      starts_.back().Q = calc_plane_stress(ply);
      const double end = starts_.back().z + ply.thickness;
      const Eigen::Vector2d f = at(starts_.size() - 1, end);
      starts_.push_back({end, f, Matrix3::Zero()});
    }
  }

  /// @param ply index @param z in the ply
  [[nodiscard]] Eigen::Vector2d at(std::size_t ply, double z) const {
    const Start& start = starts_[ply];
    Eigen::Vector2d f = start.f;
    for (int a = 0; a < 2; ++a)
      f[a] +=
          start.Q(a, a) *
          (neutral_[a] * (z - start.z) - 0.5 * (z * z - start.z * start.z)) /
          bending_[a];
    return f;
  }

 private:
  struct Start {  // of a ply
    double z = 0.0;
    Eigen::Vector2d f;
    Matrix3 Q;
  };
  Eigen::Vector2d neutral_;
  Eigen::Vector2d bending_;
  std::vector<Start> starts_;
};

/// S by the shear stress of cylindrical bending.
Matrix2 calc_shear(const std::vector<Ply>& plies, double bottom,
                   const ShearProfile& profile) {
  // Exact for polynomials of degree 5.
  constexpr std::array<std::array<double, 2>, 3> kThickness = {
      {{0.1127016653792583, 5.0 / 18.0},
       {0.5, 8.0 / 18.0},
       {0.8872983346207417, 5.0 / 18.0}}};
  Matrix2 flexibility = Matrix2::Zero();
  double z = bottom;
  for (std::size_t i = 0; i < plies.size(); ++i) {
    const Matrix2 G = calc_shear_flexibility(plies[i]);
    const double t = plies[i].thickness;
    for (const auto& [s, weight] : kThickness) {
      const Eigen::Vector2d f = profile.at(i, z + s * t);
      flexibility += weight * t * (f * f.transpose()).cwiseProduct(G);
    }
    z += t;
  }
  return flexibility.inverse();
}

std::vector<LaminatePoint> list_points(const std::vector<Ply>& plies,
                                       double bottom,
                                       const ShearProfile& profile) {
  std::vector<LaminatePoint> points;
  double start = bottom;
  for (std::size_t i = 0; i < plies.size(); ++i) {
    const Matrix3 Q = calc_plane_stress(plies[i]);
    const double end = start + plies[i].thickness;
    const auto add = [&](SectionFace face, double z) {
      const int ply = plies.size() > 1 ? static_cast<int>(i) + 1 : 0;
      const bool is_free =
          face == SectionFace::bottom || face == SectionFace::top;
      points.push_back({face, ply, plies[i].angle, Q, z * Q,
                        is_free ? Eigen::Vector2d(Eigen::Vector2d::Zero())
                                : profile.at(i, z),
                        plies[i].material.strengths});
    };
    add(i == 0 ? SectionFace::bottom : SectionFace::ply_bottom, start);
    if (plies.size() == 1) add(SectionFace::middle, 0.5 * (start + end));
    add(i + 1 == plies.size() ? SectionFace::top : SectionFace::ply_top, end);
    start = end;
  }
  return points;
}

}  // namespace

PlyMaterial make_isotropic(double E, double nu, double density) {
  const double G = 0.5 * E / (1.0 + nu);
  return {E, E, nu, G, G, G, density, Vector6::Zero()};
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
  const ShearProfile profile(plies, laminate);
  laminate.S = calc_shear(plies, bottom, profile);
  laminate.points = list_points(plies, bottom, profile);
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
  for (LaminatePoint& point : moved.points)
    point.bending += offset * point.membrane;
  return moved;
}

}  // namespace limber::fem
