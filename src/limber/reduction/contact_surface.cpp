// SPDX-License-Identifier: BSD-3-Clause
#include "limber/reduction/contact_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "limber/common/index.hpp"
#include "limber/fem/mesh/surface.hpp"
#include "limber/reduction/contact_groups.hpp"
#include "limber/reduction/contact_parts.hpp"
#include "limber/reduction/contact_patches.hpp"
#include "limber/reduction/contact_residual.hpp"
#include "limber/reduction/slices/nodal_pieces.hpp"
#include "limber/reduction/slices/roll_off.hpp"
#include "limber/reduction/slices/slice_flexibility.hpp"
#include "limber/reduction/slices/slice_motion.hpp"
#include "limber/reduction/slices/surface_division.hpp"

namespace limber::flexbody {
namespace {

constexpr double kFlat = 1e-6;  // of the surface's size, and of the normals

Vector3 find_centre(const fem::Surface& surface) {
  Vector3 centre = Vector3::Zero();
  for (const fem::SurfacePoint& point : surface.points) centre += point.x;
  return centre / static_cast<double>(surface.points.size());
}

/// Of corners by solution, of the points between them as their mean. Hertz's
/// contribution is in the response of solid elements, not in that of beams and
/// shells.
VectorX find_residual(const BodyWithSurface& body, const ReducedBasis& basis,
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
    const auto at = static_cast<std::size_t>(p);
    if (body.has_depth(surface.points[at].node))
      residual[p] -= calc_hertz_fraction(group.material, patches[at].radius);
  }
  for (Eigen::Index p = corners; p < residual.size(); ++p) {
    const std::array<int, 2>& ends =
        surface.points[static_cast<std::size_t>(p)].ends;
    residual[p] = 0.5 * (residual[ends[0]] + residual[ends[1]]);
  }
  return residual;
}

/// A group's surface without its modes.
struct BareSurface {
  fem::Surface surface;
  Matrix3X normals;  // 3 x n
  std::vector<ContactPatch> patches;
  ContactSurface contact;
};

BareSurface make_bare_surface(const fem::Mesh& mesh, const ContactGroup& group,
                              const Vector3& center) {
  BareSurface bare;
  bare.surface = fem::make_surface(mesh, group.faces);
  bare.normals = find_normals(mesh, bare.surface);
  const VectorX radii = find_patch_radii(mesh, bare.surface, bare.normals);
  bare.patches = find_patches(mesh, bare.surface, bare.normals, radii);
  ContactSurface& contact = bare.contact;
  contact.name = group.name;
  contact.x_B.resize(3, radii.size());
  for (std::size_t p = 0; p < bare.surface.points.size(); ++p) {
    const fem::SurfacePoint& point = bare.surface.points[p];
    contact.tags.push_back(point.node < 0 ? 0 : mesh.tags[index(point.node)]);
    contact.x_B.col(static_cast<Eigen::Index>(p)) = point.x - center;
  }
  contact.patch_radius = radii;
  contact.faces = bare.surface.triangles;
  contact.youngs_modulus = group.material.youngs_modulus;
  contact.poisson_ratio = group.material.poisson_ratio;
  return bare;
}

// Of each mode the fraction along the axis along which it moves the slice most,
// of all modes' flexibility there.
void roll_off_slice(const VectorX& lambda, const Matrix3& axes,
                    ContactSlice& slice) {
  const MatrixX along =
      axes.transpose() * slice.motion_B.topLeftCorner(3, lambda.size());
  MatrixX squares(3, lambda.size());
  MatrixX fractions(3, lambda.size());
  for (int k = 0; k < 3; ++k) {
    const VectorX flexibility =
        along.row(k).transpose().cwiseAbs2().cwiseQuotient(lambda);
    squares.row(k) = find_roll_off(flexibility, lambda);
    fractions.row(k) =
        flexibility /
        std::max(flexibility.sum(), std::numeric_limits<double>::min());
  }
  for (Eigen::Index i = 0; i < lambda.size(); ++i) {
    int axis = 0;
    (void)fractions.col(i).maxCoeff(&axis);
    const double square = squares(axis, i);
    const Vector3 moved = slice.motion_B.col(i).head<3>();
    slice.flexibility_B +=
        (1.0 - square) / lambda[i] * moved * moved.transpose();
    slice.motion_B.col(i) *= std::sqrt(square);
  }
}

std::vector<ContactSlice> make_contact_slices(
    const BodyWithSurface& body, const fem::Surface& surface,
    const fem::ElasticMaterial& material, const ReducedBasis& basis,
    const MatrixX& Phi, const Vector3& center) {
  const std::vector<SurfaceSample> samples = sample_surface(body.mesh, surface);
  const double nu = material.poisson_ratio;
  const double modulus = material.youngs_modulus / (1.0 - nu * nu);
  const SurfaceDivision division =
      divide_surface(samples, basis.lambda, Phi, modulus, kMostSlices);
  const Eigen::Index nodes = body.mesh.x.cols();
  MatrixX loads(3 * nodes, 3 * std::ssize(division.slices));
  std::vector<ContactSlice> slices;
  for (const SurfaceSlice& slice : division.slices) {
    const SliceMotion motion(slice.samples);
    loads.middleCols<3>(3 * std::ssize(slices)) = motion.find_loads(nodes);
    slices.push_back(
        {.normals_B = slice.normals,
         .heights = slice.heights - slice.normals.transpose() * center,
         .centre_B = motion.centre() - center,
         .motion_B = motion.find_motion(Phi)});
    ContactSlice& made = slices.back();
    made.own_B = find_own_flexibility(slice, motion, made.motion_B,
                                      division.axes, basis.lambda, Phi);
  }
  const MatrixX residual = calc_residual_matrix(body, basis, loads);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Eigen::Index at = 3 * static_cast<Eigen::Index>(i);
    const Matrix3 R = residual.block<3, 3>(at, at);
    slices[i].flexibility_B =
        slices[i].own_B + R +
        find_excess(division.slices[i], R, division.axes, material);
    roll_off_slice(basis.lambda, division.axes, slices[i]);
  }
  return slices;
}

ContactSurface make_contact_surface(const BodyWithSurface& body,
                                    const ContactGroup& group,
                                    const ReducedBasis& basis,
                                    const MatrixX& Phi, const Vector3& center,
                                    const Progress& progress) {
  BareSurface bare = make_bare_surface(body.mesh, group, center);
  ContactSurface& contact = bare.contact;
  contact.Phi_B = average(Phi, bare.patches);
  contact.residual =
      find_residual(body, basis, bare.surface, bare.patches, group, progress);
  if (is_flat(bare.surface, bare.normals)) {
    const Vector3 normal = bare.normals.rowwise().sum().normalized();
    contact.parts = make_contact_parts(body, bare.surface, normal, basis, Phi,
                                       center, contact.patch_radius.minCoeff());
  } else {
    contact.slices = make_contact_slices(body, bare.surface, group.material,
                                         basis, Phi, center);
  }
  return std::move(bare.contact);
}

// Of the reduced body the parts or slices, whose nodes move them; their own
// deformation is that of its modes, all other that of the mesh.
void add_pieces(const fem::Mesh& mesh, const fem::Surface& surface,
                const ContactSurface& reduced, const Vector3& center,
                FullContactSurface& full) {
  full.surface.parts = reduced.parts;
  for (ContactPart& part : full.surface.parts) {
    part.motion_B.resize(6, 0);
    part.residual = part.flexibility = 0.0;
  }
  full.surface.slices = reduced.slices;
  for (ContactSlice& slice : full.surface.slices) {
    slice.motion_B.resize(6, 0);
    slice.flexibility_B = slice.own_B;
  }
  full.pieces = find_nodal_pieces(mesh, surface, full.surface, center);
}

FullContactSurface make_full_contact_surface(const fem::Mesh& mesh,
                                             const ContactGroup& group,
                                             const Vector3& center,
                                             const ReducedBody* reduced) {
  BareSurface bare = make_bare_surface(mesh, group, center);
  FullContactSurface full;
  full.surface = std::move(bare.contact);
  const auto n = std::ssize(bare.patches);
  full.surface.Phi_B.resize(3 * n, 0);
  full.surface.residual.resize(n);
  full.means.first.push_back(0);
  for (Eigen::Index p = 0; p < n; ++p) {
    const ContactPatch& patch = bare.patches[static_cast<std::size_t>(p)];
    full.surface.residual[p] =
        -calc_hertz_fraction(group.material, patch.radius);
    full.means.nodes.insert(full.means.nodes.end(), patch.nodes.begin(),
                            patch.nodes.end());
    full.means.weights.insert(full.means.weights.end(), patch.weights.begin(),
                              patch.weights.end());
    full.means.first.push_back(full.means.nodes.size());
  }
  if (reduced == nullptr) return full;
  for (const ContactSurface& surface : reduced->contact_surfaces) {
    if (surface.name != group.name) continue;
    add_pieces(mesh, bare.surface, surface, center, full);
  }
  return full;
}

}  // namespace

std::vector<ContactSurface> make_contact_surfaces(
    const MeshedBody& body, const Recipe& recipe, const ReducedBasis& basis,
    const MatrixX& Phi, const Vector3& center, const Progress& progress) {
  return make_contact_surfaces(
      body,
      find_contact_groups(body.mesh, recipe.contact_groups,
                          find_materials(body.mesh, recipe)),
      basis, Phi, center, progress);
}

std::vector<ContactSurface> make_contact_surfaces(
    const BodyWithSurface& body, const std::vector<ContactGroup>& groups,
    const ReducedBasis& basis, const MatrixX& Phi, const Vector3& center,
    const Progress& progress) {
  std::vector<ContactSurface> surfaces;
  for (const ContactGroup& group : groups)
    surfaces.push_back(
        make_contact_surface(body, group, basis, Phi, center, progress));
  return surfaces;
}

std::vector<FullContactSurface> make_full_contact_surfaces(
    const fem::Mesh& mesh, const Recipe& recipe,
    const std::vector<fem::ElasticMaterial>& materials, const Vector3& center,
    const ReducedBody* reduced) {
  std::vector<FullContactSurface> surfaces;
  for (const ContactGroup& group :
       find_contact_groups(mesh, recipe.contact_groups, materials)) {
    surfaces.push_back(make_full_contact_surface(mesh, group, center, reduced));
  }
  return surfaces;
}

bool is_flat(const fem::Surface& surface, const Matrix3X& normals) {
  const Vector3 normal = normals.rowwise().sum().normalized();
  const Vector3 centre = find_centre(surface);
  double size = 0.0;
  double height = 0.0;
  for (const fem::SurfacePoint& point : surface.points) {
    size = std::max(size, (point.x - centre).norm());
    height = std::max(height, std::abs(normal.dot(point.x - centre)));
  }
  return height <= kFlat * size &&
         ((normal.transpose() * normals).array() > 1.0 - kFlat).all();
}

}  // namespace limber::flexbody
