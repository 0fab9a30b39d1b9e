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

const Skin* find_skin(const ContactSide& side) {
  const auto* skin = std::get_if<std::shared_ptr<const Skin>>(&side.shape.kind);
  return skin == nullptr ? nullptr : skin->get();
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
  return !side.bodies.empty() && side.slices.empty();
}

bool is_flexible(const ContactSide& side) {
  return find_skin(side) != nullptr && !is_rigid_mesh(side);
}

bool is_ball(const ContactSide& side) {
  return std::holds_alternative<Sphere>(side.shape.kind);
}

bool has_parts(const ContactSide& side) {
  const Skin* skin = find_skin(side);
  return skin == nullptr || !side.bodies.empty() ||
         !skin->surface().parts.empty();
}

// Hertz's law of a ball on a flexible surface is exact, with the flexibility
// where it touches.
bool is_ball_on_skin(const ContactSide& ball, const ContactSide& skin) {
  return is_ball(ball) && is_flexible(skin);
}

}  // namespace

bool suits(const ContactSide& A, const ContactSide& B) {
  if (!has_parts(A) || !has_parts(B)) return false;
  if (is_ball_on_skin(A, B) || is_ball_on_skin(B, A)) return false;
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
  const Skin* skin = find_skin(side);
  for (std::size_t i = 0; i < side.bodies.size(); ++i) {
    const PlacedBody& body = side.bodies[i];
    if (side.slices.empty()) {
      parts.emplace_back(body);
    } else {
      parts.emplace_back(skin->surface().slices[side.slices[i]], body);
    }
  }
  if (!parts.empty()) return parts;
  if (skin == nullptr) {
    const PlacedBody body{make_body(side.shape.kind), side.shape.X_BS};
    return {PatchPart(body)};
  }
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
