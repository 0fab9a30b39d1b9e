// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/progress.hpp"
#include "flexbody/recipe.hpp"

namespace limber::flexbody {

/// What each mode carries of one load case; docs/theory/choosing.md.
struct LoadCaseStudy {
  std::string name;
  VectorX effective_mass;  ///< the report's, m [kg^1/2 N s^2]
  std::optional<double> effective_mass_total;  ///< over all modes of the mesh;
                                               ///< none if they are too many
  VectorX compliance;                          ///< m [J]
  double compliance_total = 0.0;               ///< f^T K^+ f [J]
};

/// How the modes of a clamped body answer a motion of its base in x, y, z.
struct BaseMotionStudy {
  Matrix3X factors;                 ///< participation factors, 3 x m [kg^1/2]
  Matrix3X effective_mass;          ///< 3 x m [kg]
  Vector3 total = Vector3::Zero();  ///< over all modes: of free nodes [kg]
};

/// A body's modes and what they are good for.
struct ModeStudy {
  std::size_t mesh_nodes = 0;
  std::size_t mesh_elements = 0;
  std::size_t mesh_boundary_nodes = 0;
  bool clamped = false;
  double mass = 0.0;                    ///< [kg]
  Vector3 p_MoBcm_M = Vector3::Zero();  ///< c.m. in the mesh frame [m]
  Matrix3 inertia = Matrix3::Zero();    ///< about the c.m. [kg m^2]
  VectorX lambda;                       ///< m eigenvalues [rad^2/s^2]
  std::vector<LoadCaseStudy> cases;     ///< of the recipe's loads, if any
  std::optional<BaseMotionStudy> base;  ///< of a clamped body
  std::vector<std::string> notices;     ///< of its mesh
};

/// Studies the lowest `recipe.basis.eigenmodes` modes. Linked by
/// limber::reduction.
/// @throws InputError naming the file, group or value; NumericalError if an
/// eigenpair or a solve misses its tolerance.
[[nodiscard]] ModeStudy study_modes(const Recipe& recipe,
                                    const Progress& progress = {});

/// The same of the recipe's whole basis: the span of `recipe.basis.eigenmodes`
/// lowest modes and of the static-deformation modes of its interfaces and
/// loads, each with its Krylov terms, in the one form that bodies have. Its
/// eigenvalues are those that the basis gives, not lower than the mesh's.
[[nodiscard]] ModeStudy study_basis(const Recipe& recipe,
                                    const Progress& progress = {});

}  // namespace limber::flexbody
