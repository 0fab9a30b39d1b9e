// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/patches/patch_moduli.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/common/restitution.hpp"
#include "limber/contact/law/impact_estimate.hpp"
#include "limber/contact/shapes/shape_measures.hpp"
#include "limber/contact/shapes/shape_properties.hpp"

namespace limber::contact {
namespace {

// Whose ratios count where no side has a material.
constexpr SurfaceMaterial kAssumed{1.0, 0.3};

bool is_ball(const ContactSide& side) {
  return std::holds_alternative<Sphere>(side.shape.kind);
}

// Mean, of the round side of a shape; 0 of others [1/m].
template <typename Kind>
double find_curvature(const Kind& kind) {
  return std::visit(
      Overloaded{[](const Sphere& ball) { return 1.0 / ball.radius; },
                 [](const Capsule& rod) { return 0.5 / rod.radius; },
                 [](const Cylinder& rod) { return 0.5 / rod.radius; },
                 [](const Cone& cone) { return 0.5 / cone.radius; },
                 [](const Ellipsoid& body) { return 3.0 / body.radii.sum(); },
                 [](const auto&) { return 0.0; }},
      kind);
}

// Of parts the largest one.
double find_curvature(const ContactSide& side) {
  double curvature = find_curvature(side.shape.kind);
  for (const PlacedBody& body : side.bodies) {
    curvature = std::max(curvature, find_curvature(body.kind));
  }
  return curvature;
}

std::vector<ConvexSolid> list_solids(const ContactSide& side) {
  std::vector<ConvexSolid> solids;
  for (const PlacedBody& body : side.bodies) {
    const auto* solid = std::get_if<ConvexSolid>(&body.kind);
    if (solid != nullptr) solids.push_back(*solid);
  }
  return solids;
}

double find_width(const std::vector<ConvexSolid>& solids, const Vector3& n) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const ConvexSolid& solid : solids) {
    low = std::min(low, solid.find_low(n));
    high = std::max(high, solid.find_high(n));
  }
  return high - low;
}

// Of a rigid mesh the least width normal to a face.
double find_flat_radius(const ContactSide& side) {
  const std::vector<ConvexSolid> solids = list_solids(side);
  if (solids.empty()) return find_roundness(side.shape, side.shape);
  double width = std::numeric_limits<double>::infinity();
  for (const ConvexSolid& solid : solids) {
    for (const ConvexSolid::Face& face : solid.faces()) {
      width = std::min(width, find_width(solids, face.plane.n));
    }
  }
  return 0.5 * width;
}

PairModuli scale(const PairModuli& moduli, double by) {
  return {by * moduli.normal, by * moduli.tangential, by * moduli.torsional};
}

double find_default_modulus(double mass, double radius) {
  constexpr double kDepth = 0.1;  // over the radius
  const double turn = kHertzDuration / kImpactDuration;
  return 15.0 / 16.0 * turn * turn * mass / (std::sqrt(kDepth) * radius);
}

}  // namespace

double find_touch_radius(const ContactSide& A, const ContactSide& B) {
  const double curvature = find_curvature(A) + find_curvature(B);
  if (curvature > 0.0) return 1.0 / curvature;
  return std::max(find_flat_radius(A), find_flat_radius(B));
}

PairModuli find_patch_moduli(const ContactSide& A, const ContactSide& B,
                             const ContactParameters& parameters) {
  check(parameters);
  const double radius = find_touch_radius(A, B);
  const double mass = check_masses(A, B);
  const bool has_ball = is_ball(A) || is_ball(B);
  if (parameters.radius && !parameters.stiffness && !has_ball) {
    throw InputError(fmt::format(
        "contact: 'radius' does not apply to a {} and a {}, whose curvature "
        "follows from their shapes; leave it out, or add 'stiffness'",
        name_kind(A.shape), name_kind(B.shape)));
  }
  const auto of_materials = find_pair_moduli(A.material, B.material);
  const PairModuli moduli =
      of_materials ? *of_materials : *find_pair_moduli(kAssumed, std::nullopt);
  if (parameters.stiffness) {
    const double R = has_ball ? radius : parameters.radius.value_or(radius);
    return scale(moduli,
                 0.75 * *parameters.stiffness / std::sqrt(R) / moduli.normal);
  }
  if (!of_materials) {
    return scale(moduli, find_default_modulus(mass, radius) / moduli.normal);
  }
  return scale(moduli, std::sqrt(parameters.radius.value_or(radius) / radius));
}

}  // namespace limber::contact
