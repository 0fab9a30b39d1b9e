// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_sides.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/patches/ball_on_surface.hpp"
#include "limber/contact/patches/part_patches.hpp"
#include "limber/contact/patches/patch_moduli.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

namespace limber::contact {
namespace {

// Of parts.
constexpr std::size_t kMostPairs = 4096;

const MeshSurface* find_mesh_surface(const ContactSide& side) {
  const auto* mesh_surface =
      std::get_if<std::shared_ptr<const MeshSurface>>(&side.shape.kind);
  return mesh_surface == nullptr ? nullptr : mesh_surface->get();
}

double find_area(const flexbody::ContactPart& part) {
  Vector3 twice = Vector3::Zero();
  const Vector3 first = part.corners_B.col(0);
  for (Eigen::Index i = 1; i + 1 < part.corners_B.cols(); ++i) {
    twice += (Vector3(part.corners_B.col(i)) - first)
                 .cross(Vector3(part.corners_B.col(i + 1)) - first);
  }
  return 0.5 * twice.norm();
}

// R, and what 2 R_res has above the compliance of the own half space, 1 / (2 E'
// a), E' = E / (1 - nu^2); 0 without modes [m/N].
double find_flexibility(const flexbody::ContactPart& part,
                        const std::optional<SurfaceMaterial>& material) {
  if (part.motion_B.cols() == 0) return 0.0;
  double own = 0.0;
  if (material) {
    const double nu = material->poisson_ratio;
    const double a = std::sqrt(find_area(part) / std::numbers::pi);
    own = (1.0 - nu * nu) / (2.0 * material->youngs_modulus * a);
  }
  return part.flexibility + std::max(2.0 * part.residual - own, 0.0);
}

bool has_parts(const ContactSide& side) {
  const MeshSurface* mesh_surface = find_mesh_surface(side);
  return mesh_surface == nullptr || !side.bodies.empty() ||
         !mesh_surface->surface().parts.empty();
}

}  // namespace

bool has_ball_on_surface(const ContactSide& A, const ContactSide& B) {
  return BallOnSurface::suits(A, B) || BallOnSurface::suits(B, A);
}

bool suits(const ContactSide& A, const ContactSide& B) {
  if (has_ball_on_surface(A, B)) return true;
  if (!has_parts(A) || !has_parts(B)) return false;
  const std::vector<PatchPart> parts_A = make_parts(A);
  const std::vector<PatchPart> parts_B = make_parts(B);
  if (parts_A.size() * parts_B.size() > kMostPairs) return false;
  return std::ranges::all_of(parts_A, [&](const PatchPart& of_A) {
    return std::ranges::all_of(parts_B, [&](const PatchPart& of_B) {
      return PairPotential::suits(of_A.body().kind, of_B.body().kind);
    });
  });
}

std::vector<PatchPart> make_parts(const ContactSide& side) {
  std::vector<PatchPart> parts;
  const MeshSurface* mesh_surface = find_mesh_surface(side);
  for (std::size_t i = 0; i < side.bodies.size(); ++i) {
    const PlacedBody& body = side.bodies[i];
    if (side.slices.empty()) {
      parts.emplace_back(body);
      continue;
    }
    const std::size_t slice = side.slices[i];
    parts.emplace_back(mesh_surface->surface().slices[slice], body);
    if (mesh_surface->has_pieces())
      parts.back().move_with(mesh_surface->pieces()[slice]);
  }
  if (!parts.empty()) return parts;
  if (mesh_surface == nullptr) {
    const PlacedBody body{make_body(side.shape.kind), side.shape.X_BS};
    return {PatchPart(body)};
  }
  for (const flexbody::ContactPart& part : mesh_surface->surface().parts) {
    const std::size_t i = parts.size();
    parts.emplace_back(part, find_flexibility(part, side.material));
    if (mesh_surface->has_pieces())
      parts.back().move_with(mesh_surface->pieces()[i]);
  }
  return parts;
}

std::unique_ptr<const PatchFinder> make_finder(
    const ContactSide& A, const ContactSide& B, double modulus,
    const ContactParameters& parameters) {
  LIMBER_EXPECT(suits(A, B));
  if (!has_ball_on_surface(A, B)) {
    return std::make_unique<const PartPatches>(make_parts(A), make_parts(B),
                                               modulus);
  }
  std::optional<double> radius;
  if (parameters.radius || parameters.stiffness) {
    radius = find_touch_radius(A, B);
  }
  return std::make_unique<const BallOnSurface>(A, B, modulus, radius);
}

}  // namespace limber::contact
