// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"

namespace limber::fem {

/// Corners of a round outline.
inline constexpr int kRoundCorners = 12;

/// A place in a section and its shear stress [xy, xz] per force and moment.
struct SectionPoint {
  double y = 0.0;  ///< [length]
  double z = 0.0;
  /// Per shear force along y and along z [1/length^2].
  Eigen::Vector2d shear_y = Eigen::Vector2d::Zero();
  Eigen::Vector2d shear_z = Eigen::Vector2d::Zero();
  /// Per torsional moment, 1/W_t along the outline or wall [1/length^3].
  Eigen::Vector2d torsion = Eigen::Vector2d::Zero();
  bool is_inner = false;  ///< not on the outline
};

/// Cross-section of a beam about its centroid, which is its shear centre. Axes
/// y and z of the section; x is that of the beam. Units are those of the model.
struct BeamSection {
  double area = 0.0;  ///< A > 0 [length^2]
  double I_y = 0.0;   ///< int z^2 dA > 0, bending in the plane x z [length^4]
  double I_z = 0.0;   ///< int y^2 dA > 0, bending in the plane x y [length^4]
  double I_yz = 0.0;  ///< int y z dA [length^4]
  double torsion = 0.0;  ///< It > 0, without warping [length^4]
  /// W_t: torsional moment over its largest shear stress; 0: not known, of
  /// sections without dimensions [length^3].
  double torsion_modulus = 0.0;
  /// Shear factors: the shear force along y is shear_y G A gamma; 0: no shear
  /// flexibility (Euler and Bernoulli) [-].
  double shear_y = 0.0;
  double shear_z = 0.0;      ///< the same along z [-]
  double extra_mass = 0.0;   ///< on the axis, without rotary inertia
                             ///< [mass/length]
  double half_height = 0.0;  ///< of pictures, along y [length]
  double half_width = 0.0;   ///< of pictures, along z [length]
  bool is_round = false;     ///< of pictures
  /// Where stress is taken: the corners of list_outline() in its order, then
  /// others; of a section without dimensions none.
  std::vector<SectionPoint> points;
};

/// Shear factors of all: Cowper, The Shear Coefficient in Timoshenko's Beam
/// Theory, J. Appl. Mech. 33 (1966) 335-340. @param nu Poisson's ratio [-]
/// Shear stress of shear forces of all: V Q / (I t) (Jourawski), of walls along
/// them.

/// Ring of outer and inner radius, 0 <= inner < outer. Shear stress along its
/// circle, V (a^2 + a b + b^2) / (3 I) at the neutral axis.
[[nodiscard]] BeamSection make_tube(double outer, double inner, double nu);

/// @param height along y @param width along z
/// Torsion: series of Saint-Venant. Points in the middles of sides and in the
/// middle: 3/2 V / A.
[[nodiscard]] BeamSection make_rectangle(double height, double width,
                                         double nu);

/// Rectangular tube, outer sizes as above.
/// @param top thickness of the two walls along z @param side of those along y
/// Torsion: Bredt. Points in the middles of walls, at the neutral axes; at the
/// corners the flow of thin walls over the thinner one.
[[nodiscard]] BeamSection make_box(double height, double width, double top,
                                   double side, double nu);

/// Doubly symmetric I, web along y.
/// Torsion: thin open walls, sum b t^3 / 3. The factor along z is that of the
/// two flanges as rectangles. Points in the middles of the flanges, with the
/// flow of both sides, and on both faces of the web, in its middle and at the
/// flanges.
[[nodiscard]] BeamSection make_i_section(double height, double width,
                                         double flange, double web, double nu);

}  // namespace limber::fem
