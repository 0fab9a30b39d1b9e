// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "limber/common/material/solid_material.hpp"
#include "limber/fem/mesh/mesh.hpp"

namespace limber::fem {

using ElasticMaterial = SolidMaterial;

/// A material and its volume group; an empty name means every element that no
/// other assignment covers.
struct MaterialAssignment {
  std::string group;
  ElasticMaterial material;
};

/// The material of each region (index into Mesh::volume_groups): the one that
/// is assigned, or else that of the mesh's file.
/// @throws InputError, all problems at once, for values out of range, an
/// unknown group, a region assigned twice or not at all, a nameless material
/// with no region left; and for a material of the file that is out of all
/// proportion in its units.
[[nodiscard]] std::vector<ElasticMaterial> assign_materials(
    const Mesh& mesh, const std::vector<MaterialAssignment>& assignments);

/// Of each region that has the file's material a line for reports.
[[nodiscard]] std::vector<std::string> describe_file_materials(
    const Mesh& mesh, const std::vector<MaterialAssignment>& assignments);

}  // namespace limber::fem
