// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "limber/fem/structural/beam_section.hpp"
#include "limber/fem/structural/structural_element.hpp"

namespace limber::fem {

/// A straight beam of one section between two nodes.
struct BeamShape {
  std::array<Vector3, 2> nodes;  ///< positions
  /// From the nodes to the ends of the axis, rigid.
  std::array<Vector3, 2> offsets = {Vector3::Zero(), Vector3::Zero()};
  /// Gives the section's y axis by its part across the beam.
  Vector3 up = Vector3::UnitY();
};

struct BeamMaterial {
  double youngs_modulus = 0.0;  ///< E
  double shear_modulus = 0.0;   ///< G
  double density = 0.0;         ///< rho

  [[nodiscard]] double poissons_ratio() const {
    return 0.5 * youngs_modulus / shear_modulus - 1.0;
  }
};

/// Axes x, y, z of the beam's section as columns. @throws InputError, without
/// its place, for a beam without length or `up` along it
[[nodiscard]] Matrix3 find_beam_axes(const BeamShape& shape);

/// Timoshenko's beam.
///
/// Equation   stiffness exact for loads at the nodes; deflection cubic,
///            rotation quadratic, with Phi = 12 E I / (k G A L^2); mass
///            consistent with rotary inertia
/// Source     Przemieniecki (1968), ch. 5; Friedman, Kosmatka, An improved
///            two-node Timoshenko beam finite element, Comput. Struct. 47
///            (1993) 473-481
/// Limits     the centroid is the shear centre; no warping
/// @returns 12 x 12 @throws InputError as find_beam_axes
[[nodiscard]] StructuralElement make_beam(const BeamShape& shape,
                                          const BeamSection& section,
                                          const BeamMaterial& material);

}  // namespace limber::fem
