// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_groups.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "limber/common/errors.hpp"
#include "limber/common/index.hpp"
#include "limber/common/material/half_space.hpp"
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
Faces find_mesh_surface(const fem::Mesh& mesh) {
  for (const fem::PhysicalGroup& group : mesh.groups) {
    if (group.name != kWholeSurface ||
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
  if (name == kWholeSurface) return find_mesh_surface(mesh);
  const fem::PhysicalGroup& group = mesh.groups[fem::find_group(mesh, name)];
  Faces faces = fem::find_group_faces(mesh, group);
  if (!faces.empty()) return faces;
  throw InputError(fmt::format(
      "{}: contact group '{}' (dimension {}) has no faces on the body's "
      "surface. Expected {}or 'skin' for all of it.",
      mesh.source, name, group.dimension, list_surface_groups(mesh)));
}

/// Normal of a face times its area, and its middle, by its corners.
struct FlatFace {
  Vector3 area;  // [m^2]
  Vector3 middle;
};

FlatFace flatten(const fem::Mesh& mesh, const fem::BoundaryFace& face) {
  const fem::ReferenceElement& element =
      *mesh.blocks[index(face.block)].element;
  std::vector<int> corners = fem::face_nodes(mesh, face);
  corners.resize(
      static_cast<std::size_t>(element.face_corners[index(face.face)]));
  const Matrix3X x = mesh.x(Eigen::all, corners);
  const Vector3 first = x.col(2) - x.col(0);
  const Vector3 second = x.col(x.cols() - 1) - x.col(1);
  const Vector3 area =
      x.cols() == 4 ? first.cross(second) : (x.col(1) - x.col(0)).cross(first);
  return {0.5 * area, x.rowwise().mean()};
}

/// The isotropic material of the same compliances under point forces, mean over
/// the faces' area.
fem::ElasticMaterial find_isotropic(const fem::Mesh& mesh, const Faces& faces,
                                    const fem::ElasticMaterial& material) {
  constexpr double kSameNormal = 1e-6;
  const Anisotropy& own = *material.anisotropy;
  Vector3 known = Vector3::Zero();  // in material axes
  SurfaceCompliance compliance;
  SurfaceCompliance mean;
  double total = 0.0;
  for (const fem::BoundaryFace& boundary : faces) {
    const FlatFace face = flatten(mesh, boundary);
    const double area = face.area.norm();
    const Vector3 normal =
        own.axes.at(face.middle).transpose() * face.area / area;
    if ((normal - known).norm() > kSameNormal) {
      compliance = find_surface_compliance(own.C, normal);
      known = normal;
    }
    mean.normal += area * compliance.normal;
    mean.tangential += area * compliance.tangential;
    total += area;
  }
  fem::ElasticMaterial isotropic =
      find_isotropic_surface({mean.normal / total, mean.tangential / total});
  isotropic.density = material.density;
  return isotropic;
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
    if (have_same_elasticity(other, first)) continue;
    throw InputError(fmt::format(
        "{}: contact group '{}' covers materials of E = {:.6g} Pa, nu = {:.6g} "
        "and E = {:.6g} Pa, nu = {:.6g}. Make a group of each.",
        mesh.source, name, first.youngs_modulus, first.poisson_ratio,
        other.youngs_modulus, other.poisson_ratio));
  }
  return first.anisotropy ? find_isotropic(mesh, faces, first) : first;
}

}  // namespace

ContactGroup make_contact_group(
    const fem::Mesh& mesh, const std::string& name, Faces faces,
    const std::vector<fem::ElasticMaterial>& materials) {
  const fem::ElasticMaterial material =
      find_material(mesh, name, faces, materials);
  return {name, std::move(faces), material};
}

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
    groups.push_back(
        make_contact_group(mesh, name, find_faces(mesh, name), materials));
  }
  return groups;
}

}  // namespace limber::flexbody
