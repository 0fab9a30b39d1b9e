// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_sides.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <variant>

#include "limber/common/errors.hpp"
#include "limber/contact/potential/pair_potential.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

// Of parts.
constexpr std::size_t kMostPairs = 4096;

const Skin* find_skin(const ShapeKind& shape) {
  const auto* skin = std::get_if<std::shared_ptr<const Skin>>(&shape);
  return skin == nullptr ? nullptr : skin->get();
}

const Skin* find_skin(const ContactSide& side) {
  return find_skin(side.shape.kind);
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

bool is_rigid_mesh(const ContactSide& side) {
  return !side.solids.empty() && side.slices.empty();
}

// Flat faces alone: a solid or several, or a flexible surface with parts.
bool is_flat(const ContactSide& side) {
  if (!side.solids.empty()) return true;
  const Skin* skin = find_skin(side);
  return skin == nullptr ? is_solid(side.shape.kind)
                         : !skin->surface().parts.empty();
}

// Whether these flat faces have a potential with a round shape. Hertz's law of
// a ball on a flexible flat is exact, with the flexibility where it touches.
bool suits_round(const ContactSide& flat, const ShapeKind& shape) {
  if (find_skin(shape) != nullptr) return false;
  const BodyKind body = make_body(shape);
  const auto suits_body = [&](const ConvexSolid& solid) {
    return PairPotential::suits(solid, body);
  };
  const bool is_flexible = find_skin(flat) != nullptr && !is_rigid_mesh(flat);
  if (is_flexible && std::holds_alternative<Sphere>(shape)) return false;
  if (!flat.solids.empty()) return std::ranges::all_of(flat.solids, suits_body);
  return is_flexible || suits_body(ConvexSolid(flat.shape.kind));
}

std::size_t count_parts(const ContactSide& side) {
  return std::max(side.solids.size(), std::size_t{1});
}

}  // namespace

bool suits(const ContactSide& A, const ContactSide& B) {
  const auto is_bounded = [](const ContactSide& side) {
    return !std::holds_alternative<HalfSpace>(side.shape.kind);
  };
  if (count_parts(A) * count_parts(B) > kMostPairs) return false;
  if (is_flat(A) && is_flat(B)) return is_bounded(A) || is_bounded(B);
  if (is_flat(A)) return suits_round(A, B.shape.kind);
  if (is_flat(B)) return suits_round(B, A.shape.kind);
  return find_skin(A) == nullptr && find_skin(B) == nullptr &&
         PairPotential::suits(make_body(A.shape.kind), make_body(B.shape.kind));
}

std::vector<PatchPart> make_parts(const ContactSide& side) {
  std::vector<PatchPart> parts;
  const Skin* skin = find_skin(side);
  for (std::size_t i = 0; i < side.solids.size(); ++i) {
    const ConvexSolid& solid = side.solids[i];
    if (side.slices.empty()) {
      parts.emplace_back(solid, side.shape.X_BS);
    } else {
      parts.emplace_back(skin->surface().slices[side.slices[i]], solid);
    }
  }
  if (!parts.empty()) return parts;
  if (skin == nullptr) return {PatchPart(side.shape)};
  for (const flexbody::ContactPart& part : skin->surface().parts) {
    parts.emplace_back(part, find_flexibility(part, side.material));
  }
  return parts;
}

std::vector<SeriesPotential> make_potentials(
    const std::vector<PatchPart>& parts_A,
    const std::vector<PatchPart>& parts_B, double modulus) {
  std::vector<SeriesPotential> potentials;
  for (const PatchPart& A : parts_A) {
    for (const PatchPart& B : parts_B) {
      potentials.emplace_back(A.body(), B.body(), modulus, A.flexibility(),
                              B.flexibility());
    }
  }
  return potentials;
}

}  // namespace limber::contact
