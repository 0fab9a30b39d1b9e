// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_groups.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/mesh/surface.hpp"

namespace limber::flexbody {
namespace {

using Faces = std::vector<fem::BoundaryFace>;

std::string list_surface_groups(const fem::Mesh& mesh) {
  std::string names;
  for (const fem::PhysicalGroup& group : mesh.groups)
    if (group.dimension == 2) names += fmt::format("'{}', ", group.name);
  return names;
}

/// The mesh needs no group for it; if it has one of this name, that must be
/// the same.
Faces find_skin(const fem::Mesh& mesh) {
  for (const fem::PhysicalGroup& group : mesh.groups) {
    if (group.name != kWholeSkin ||
        fem::find_group_faces(mesh, group).size() == mesh.boundary_faces.size())
      continue;
    throw InputError(
        fmt::format("{}: contact group 'skin' is the whole surface, but a "
                    "group of this name is only a part of it. Rename it.",
                    mesh.source));
  }
  return mesh.boundary_faces;
}

Faces find_faces(const fem::Mesh& mesh, const std::string& name) {
  if (name == kWholeSkin) return find_skin(mesh);
  const fem::PhysicalGroup& group = mesh.groups[fem::find_group(mesh, name)];
  Faces faces = fem::find_group_faces(mesh, group);
  if (!faces.empty()) return faces;
  throw InputError(fmt::format(
      "{}: contact group '{}' (dimension {}) has no faces on the body's "
      "surface. Expected {}or 'skin' for all of it.",
      mesh.source, name, group.dimension, list_surface_groups(mesh)));
}

bool is_same(const fem::ElasticMaterial& a, const fem::ElasticMaterial& b) {
  return a.youngs_modulus == b.youngs_modulus &&
         a.poisson_ratio == b.poisson_ratio;
}

fem::ElasticMaterial find_material(
    const fem::Mesh& mesh, const std::string& name, const Faces& faces,
    const std::vector<fem::ElasticMaterial>& materials) {
  const auto under = [&](const fem::BoundaryFace& face) {
    const fem::ElementBlock& block = mesh.blocks[index(face.block)];
    return materials[index(block.regions[face.element])];
  };
  const fem::ElasticMaterial first = under(faces.front());
  for (const fem::BoundaryFace& face : faces) {
    const fem::ElasticMaterial other = under(face);
    if (is_same(other, first)) continue;
    throw InputError(fmt::format(
        "{}: contact group '{}' covers materials of E = {:.6g} Pa, nu = {:.6g} "
        "and E = {:.6g} Pa, nu = {:.6g}. Make a group of each.",
        mesh.source, name, first.youngs_modulus, first.poisson_ratio,
        other.youngs_modulus, other.poisson_ratio));
  }
  return first;
}

}  // namespace

std::vector<ContactGroup> find_contact_groups(
    const fem::Mesh& mesh, const std::vector<std::string>& names,
    const std::vector<fem::ElasticMaterial>& materials) {
  std::vector<ContactGroup> groups;
  for (const std::string& name : names) {
    if (std::any_of(
            groups.begin(), groups.end(),
            [&](const ContactGroup& other) { return other.name == name; }))
      throw InputError(
          fmt::format("{}: contact group '{}' is named twice. Name it once.",
                      mesh.source, name));
    Faces faces = find_faces(mesh, name);
    const fem::ElasticMaterial material =
        find_material(mesh, name, faces, materials);
    groups.push_back({name, std::move(faces), material});
  }
  return groups;
}

}  // namespace limber::flexbody
