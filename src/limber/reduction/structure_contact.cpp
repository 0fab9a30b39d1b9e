// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/structure_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/fem/mesh/mesh_checks.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_surface.hpp"
#include "limber/reduction/matrices/matrix_interfaces.hpp"

namespace limber::flexbody {
namespace {

using Side = fem::ModelSurface::Side;

/// A set and a side of its shells.
std::pair<std::string, Side> split_side(const MatrixSystem& system,
                                        const std::string& name) {
  const bool is_set = std::ranges::any_of(
      system.sets, [&](const auto& set) { return set.name == name; });
  const std::size_t dot = is_set ? std::string::npos : name.rfind('.');
  if (dot == std::string::npos) return {name, Side::none};
  const std::string side = name.substr(dot + 1);
  if (side == "top") return {name.substr(0, dot), Side::top};
  if (side == "bottom") return {name.substr(0, dot), Side::bottom};
  return {name, Side::none};
}

std::vector<fem::BoundaryFace> find_set_faces(const MatrixSystem& system,
                                              const fem::Mesh& mesh,
                                              const std::string& name) {
  if (name == kWholeSurface) return mesh.boundary_faces;
  const auto [set, side] = split_side(system, name);
  const std::vector<int> nodes = find_matrix_nodes(system, set);
  std::vector<fem::BoundaryFace> faces;
  for (const fem::BoundaryFace& face : mesh.boundary_faces) {
    const std::vector<int> own = fem::face_nodes(mesh, face);
    if (std::ranges::all_of(own, [&, on = side](int node) {
          return std::ranges::binary_search(
                     nodes, system.mesh_surface.bases[index(node)]) &&
                 (on == Side::none ||
                  system.mesh_surface.sides[index(node)] == on);
        }))
      faces.push_back(face);
  }
  if (faces.empty())
    throw InputError(fmt::format(
        "{}: contact group '{}' has no faces on the body's surface. Expected a "
        "set with all nodes of some elements, of shells also SET.top or "
        "SET.bottom, or 'skin' for all of it.",
        system.source, name));
  return faces;
}

/// What of a structure the groups are.
struct StructureContact {
  fem::Mesh mesh;  // of the surface, with its boundary
  std::vector<ContactGroup> groups;
};

StructureContact find_contact(const MatrixSystem& system,
                              const std::vector<std::string>& names) {
  StructureContact contact;
  contact.mesh = system.mesh_surface.mesh;
  fem::find_boundary(contact.mesh);
  for (const std::string& name : names) {
    if (std::ranges::count(names, name) > 1)
      throw InputError(
          fmt::format("{}: contact group '{}' is named twice. Name it once.",
                      system.source, name));
    contact.groups.push_back(make_contact_group(
        contact.mesh, name, find_set_faces(system, contact.mesh, name),
        system.mesh_surface.materials));
  }
  return contact;
}

MatrixX take_translations(const MatrixX& fields) {
  const Eigen::Index nodes = fields.rows() / 6;
  MatrixX taken(3 * nodes, fields.cols());
  for (Eigen::Index n = 0; n < nodes; ++n)
    taken.middleRows<3>(3 * n) = fields.middleRows<3>(6 * n);
  return taken;
}

}  // namespace

SurfaceMaker make_structure_surfaces(
    const std::shared_ptr<const MatrixPart>& part, const Recipe& recipe,
    const Progress& progress) {
  if (recipe.contact_groups.empty() || !part->system.is_structure) return {};
  const auto contact = std::make_shared<const StructureContact>(
      find_contact(part->system, recipe.contact_groups));
  return [part, contact, progress](
             const MatrixBody& body, const ReducedBasis& basis,
             const MatrixX& fields, const Vector3& center) {
    return make_contact_surfaces(
        {body, part->system.mesh_surface, contact->mesh}, contact->groups,
        basis, take_translations(fields), center, progress);
  };
}

}  // namespace limber::flexbody
