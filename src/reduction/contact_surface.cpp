// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_surface.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "limber/common/index.hpp"
#include "limber/fem/mesh/surface.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_pads.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_radii.hpp"
#include "limber/reduction/contact_residual.hpp"

namespace limber::flexbody {
namespace {

/// Of corners by solution, of the points between them as their mean.
VectorX find_residual(const MeshedBody& body, const ReducedBasis& basis,
                      const fem::Surface& surface,
                      std::vector<ContactPatch> patches,
                      const ContactGroup& group, const Progress& progress) {
  VectorX residual(static_cast<Eigen::Index>(patches.size()));
  const auto corners = std::count_if(
      surface.points.begin(), surface.points.end(),
      [](const fem::SurfacePoint& point) { return point.is_corner(); });
  patches.resize(static_cast<std::size_t>(corners));
  residual.head(corners) = calc_residual_flexibility(
      body, basis, patches, fmt::format("contact surface '{}'", group.name),
      progress);
  for (Eigen::Index p = 0; p < corners; ++p) {
    residual[p] -= calc_hertz_share(
        group.material, patches[static_cast<std::size_t>(p)].radius);
  }
  for (Eigen::Index p = corners; p < residual.size(); ++p) {
    const std::array<int, 2>& ends =
        surface.points[static_cast<std::size_t>(p)].ends;
    residual[p] = 0.5 * (residual[ends[0]] + residual[ends[1]]);
  }
  return residual;
}

ContactSurface make_contact_surface(const MeshedBody& body,
                                    const ContactGroup& group,
                                    const ReducedBasis& basis,
                                    const MatrixX& Phi, const Vector3& center,
                                    const Progress& progress) {
  const fem::Mesh& mesh = body.mesh;
  const fem::Surface surface = fem::make_surface(mesh, group.faces);
  const Matrix3X normals = find_normals(mesh, surface);
  const VectorX radii = find_patch_radii(mesh, surface, normals);
  const std::vector<ContactPatch> patches =
      find_patches(mesh, surface, normals, radii);
  ContactSurface contact;
  contact.name = group.name;
  contact.x_B.resize(3, radii.size());
  for (std::size_t p = 0; p < surface.points.size(); ++p) {
    const fem::SurfacePoint& point = surface.points[p];
    contact.tags.push_back(point.node < 0 ? 0 : mesh.tags[index(point.node)]);
    contact.x_B.col(static_cast<Eigen::Index>(p)) = point.x - center;
  }
  contact.Phi_B = average(Phi, patches);
  contact.residual =
      find_residual(body, basis, surface, patches, group, progress);
  contact.patch_radius = radii;
  contact.faces = surface.triangles;
  if (is_flat(surface, normals)) {
    contact.pads =
        make_contact_pads(body, surface, normals, basis, Phi, center);
  }
  contact.youngs_modulus = group.material.youngs_modulus;
  contact.poisson_ratio = group.material.poisson_ratio;
  return contact;
}

}  // namespace

std::vector<ContactSurface> make_contact_surfaces(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis,
    const MatrixX& Phi, const Vector3& center, const Progress& progress) {
  std::vector<ContactSurface> surfaces;
  for (const ContactGroup& group : find_contact_groups(
           body.mesh, recipe.contact_groups, find_materials(body.mesh, recipe)))
    surfaces.push_back(
        make_contact_surface(body, group, basis, Phi, center, progress));
  return surfaces;
}

}  // namespace limber::flexbody
