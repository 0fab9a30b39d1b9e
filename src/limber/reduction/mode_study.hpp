// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limber/common/progress.hpp"
#include "limber/flexbody/model/mesh_locking.hpp"
#include "limber/flexbody/model/recipe.hpp"

namespace limber::flexbody {

/// Fraction of each mode in one load case; docs/theory/choosing.md.
struct LoadCaseStudy {
  std::string name;
  VectorX effective_mass;  ///< the report's, m [kg^1/2 N s^2]
  /// Over all modes of the mesh [kg^1/2 N s^2]; none if there are too many.
  std::optional<double> effective_mass_total;
  VectorX compliance;             ///< m [J]
  double compliance_total = 0.0;  ///< f^T K^+ f [J]
};

/// Response of a clamped body's modes to a motion of its base in x, y, z.
struct BaseMotionStudy {
  Matrix3X factors;                 ///< participation factors, 3 x m [kg^1/2]
  Matrix3X effective_mass;          ///< 3 x m [kg]
  Vector3 total = Vector3::Zero();  ///< over all modes: of free nodes [kg]
};

/// A body's modes and their fractions of loads and base motion.
struct ModeStudy {
  std::size_t mesh_nodes = 0;           ///< count
  std::size_t mesh_elements = 0;        ///< count
  std::size_t mesh_boundary_nodes = 0;  ///< count
  bool clamped = false;
  double mass = 0.0;                    ///< [kg]
  Vector3 size = Vector3::Zero();       ///< bounding box edges [m]
  Vector3 p_MoBcm_M = Vector3::Zero();  ///< c.m. in the mesh frame [m]
  Matrix3 inertia = Matrix3::Zero();    ///< about the c.m. [kg m^2]
  VectorX lambda;                       ///< m eigenvalues [rad^2/s^2]
  std::vector<LoadCaseStudy> cases;     ///< of the recipe's loads, if any
  std::optional<BaseMotionStudy> base;  ///< of a clamped body
  std::optional<MeshLocking> locking;   ///< of a mesh of first order
  std::vector<std::string> notices;     ///< of its mesh or matrices
  std::vector<std::string> found;       ///< of matrices: a line for each file
};

/// A mesh with its materials, without a reduction.
struct PartMass {
  double mass = 0.0;                    ///< [kg]
  Vector3 p_MoBcm_M = Vector3::Zero();  ///< c.m. in the mesh frame [m]
  Vector3 size = Vector3::Zero();       ///< bounding box edges [m]
  std::vector<std::string> notices;     ///< of its mesh
};
/// @throws InputError naming the file, group or value.
[[nodiscard]] PartMass find_part_mass(const Recipe& recipe,
                                      const Progress& progress = {});

/// Studies the lowest `recipe.basis.eigenmodes` modes. Linked by
/// limber::reduction.
/// @throws InputError naming the file, group or value; NumericalError if an
/// eigenpair or a solve misses its tolerance.
[[nodiscard]] ModeStudy study_modes(const Recipe& recipe,
                                    const Progress& progress = {});

/// The same for the recipe's whole basis: the span of `recipe.basis.eigenmodes`
/// lowest modes and of the static-deformation modes of its interfaces and
/// loads, each with its Krylov terms, in canonical form. Its eigenvalues are
/// those of the basis, not lower than the mesh's.
[[nodiscard]] ModeStudy study_basis(const Recipe& recipe,
                                    const Progress& progress = {});

}  // namespace limber::flexbody
