// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/material/section_place.hpp"
#include "limber/common/types.hpp"

namespace limber::fem {

using Matrix2 = Eigen::Matrix2d;

/// Orthotropic material in plane stress: 1 along the fibre, 2 across it in the
/// plane, 3 through the thickness.
struct PlyMaterial {
  double E_1 = 0.0;      ///< > 0
  double E_2 = 0.0;      ///< > 0
  double nu_12 = 0.0;    ///< nu_12^2 < E_1 / E_2 [-]
  double G_12 = 0.0;     ///< > 0
  double G_13 = 0.0;     ///< > 0
  double G_23 = 0.0;     ///< > 0
  double density = 0.0;  ///< >= 0
  /// Strengths Xt, Xc, Yt, Yc, S > 0 along 1, along 2 and in shear, and F12 of
  /// Tsai and Wu; zeros: not known.
  Vector6 strengths = Vector6::Zero();
  /// Of [11, 22, 2 12], in place of the constants where these do not describe
  /// it; zeros: they do.
  Matrix3 plane_stress = Matrix3::Zero();
};

/// The same in all directions.
[[nodiscard]] PlyMaterial make_isotropic(double E, double nu, double density);

struct Ply {
  PlyMaterial material;
  double thickness = 0.0;  ///< > 0
  double angle = 0.0;      ///< from the shell's axis 1 to the fibre [rad]
};

/// Stress at a place through the thickness, in the shell's axes: [11, 22, 12] =
/// membrane e + bending k, [13, 23] = shear * Q by components.
struct LaminatePoint {
  SectionFace face = SectionFace::middle;
  int ply = 0;         ///< from 1 at the bottom; 0: the only one
  double angle = 0.0;  ///< from axis 1 to the fibre [rad]
  Matrix3 membrane = Matrix3::Zero();
  Matrix3 bending = Matrix3::Zero();
  Eigen::Vector2d shear = Eigen::Vector2d::Zero();  ///< per shear force
  Vector6 strengths = Vector6::Zero();              ///< as PlyMaterial
};

/// A shell's section in its axes 1, 2: forces and moments per length of strains
/// [11, 22, 2 12] of the reference surface and its curvatures.
struct Laminate {
  Matrix3 A = Matrix3::Zero();  ///< N = A e + B k
  Matrix3 B = Matrix3::Zero();  ///< M = B e + D k
  Matrix3 D = Matrix3::Zero();
  Matrix2 S = Matrix2::Zero();  ///< Q = S [gamma_13, gamma_23]
  double mass = 0.0;            ///< int rho dz
  double first_mass = 0.0;      ///< int rho z dz
  double second_mass = 0.0;     ///< int rho z^2 dz
  double bottom = 0.0;          ///< z of its lower face
  double top = 0.0;             ///< z of its upper face
  PlyMaterial outer = {};       ///< of the upper face, for contact
  /// Bottom, middle and top of one ply; bottom and top of each of several.
  std::vector<LaminatePoint> points;
};

/// Plies from bottom to top, the lowest beginning at z = bottom.
///
/// Equation   A, B, D = int Qbar (1, z, z^2) dz; S^-1_ab = int f_a f_b
///            Gbar^-1_ab dz with f_a the shear stress that equilibrium gives
///            for a unit shear force in cylindrical bending along a
/// Source     Jones, Mechanics of Composite Materials (1999), ch. 4; Whitney,
///            Shear correction factors for orthotropic laminates, J. Appl.
///            Mech. 40 (1973) 302-304. Of one isotropic ply S = 5/6 G t
[[nodiscard]] Laminate make_laminate(const std::vector<Ply>& plies,
                                     double bottom);

/// The same at `offset` farther along z.
[[nodiscard]] Laminate shift_laminate(const Laminate& laminate, double offset);

}  // namespace limber::fem
