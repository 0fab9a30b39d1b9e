// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limber/fem/mesh/mesh.hpp"
#include "limber/fem/solid/material.hpp"

/// Faces of a body that may touch others. Part of limber_reduction.
namespace limber::flexbody {

/// Name of the whole boundary among contact groups.
inline constexpr std::string_view kWholeSurface = "skin";

/// A contact group of a recipe, found on its mesh.
struct ContactGroup {
  std::string name;
  std::vector<fem::BoundaryFace> faces;
  /// Under the faces; of an anisotropic one, the isotropic material whose
  /// surface is as compliant (find_surface_compliance), mean over the faces.
  fem::ElasticMaterial material;
};

/// @param faces of the mesh's boundary, at least one
/// @param materials one a region of the mesh
/// @throws InputError if they have several elasticities
[[nodiscard]] ContactGroup make_contact_group(
    const fem::Mesh& mesh, const std::string& name,
    std::vector<fem::BoundaryFace> faces,
    const std::vector<fem::ElasticMaterial>& materials);

/// @param materials one a region of the mesh
/// @throws InputError for a group that does not exist, has no faces on the
/// surface, covers several elasticities, or is named twice; and for a mesh
/// whose group "skin" is not the whole boundary.
[[nodiscard]] std::vector<ContactGroup> find_contact_groups(
    const fem::Mesh& mesh, const std::vector<std::string>& names,
    const std::vector<fem::ElasticMaterial>& materials);

}  // namespace limber::flexbody
