// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

/// Isotropic linear elasticity.
struct ElasticMaterial {
  double youngs_modulus = 0.0;  ///< E > 0 [Pa]
  double poisson_ratio = 0.0;   ///< -1 < nu < 0.5 [-]
  double density = 0.0;         ///< rho > 0 [kg/m^3]
};

/// A material and its volume group; an empty name means every element that no
/// other assignment covers.
struct MaterialAssignment {
  std::string group;
  ElasticMaterial material;
};

/// The material of each region (index into Mesh::volume_groups).
/// @throws InputError, all problems at once, for values out of range, an
/// unknown group, a region assigned twice or not at all, a nameless material
/// with no region left.
[[nodiscard]] std::vector<ElasticMaterial> assign_materials(
    const Mesh& mesh, const std::vector<MaterialAssignment>& assignments);

}  // namespace limber::fem
