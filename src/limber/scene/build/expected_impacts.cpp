// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/build/expected_impacts.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "limber/common/index.hpp"
#include "limber/common/material/half_space.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/contact/law/materials.hpp"

namespace limber::scene {
namespace {

using Material = std::optional<contact::SurfaceMaterial>;

/// A body that strikes the link.
struct Striker {
  double mass = kInfinity;  // [kg]
  Vector3 v_W = Vector3::Zero();
  Material material;
  std::optional<double> radius;  // where it is round [m]
};

std::optional<double> find_radius(const Geometry& geometry) {
  using Radius = std::optional<double>;
  return std::visit(
      Overloaded{[](const SphereGeometry& g) -> Radius { return g.radius; },
                 [](const CylinderGeometry& g) -> Radius { return g.radius; },
                 [](const CapsuleGeometry& g) -> Radius { return g.radius; },
                 [](const ConeGeometry& g) -> Radius { return g.radius; },
                 [](const EllipsoidGeometry& g) -> Radius {
                   return g.radii.minCoeff();
                 },
                 [](const BoxGeometry& g) -> Radius {
                   return 0.5 * g.size.minCoeff();
                 },
                 [](const auto&) -> Radius { return std::nullopt; }},
      geometry);
}

Striker describe_link(const Link& link, const LinkMotion& motion) {
  Striker striker;
  striker.v_W = motion.v_WL_W;
  striker.material = link.contact.material;
  if (link.inertia) striker.mass = link.inertia->mass;
  for (const Collision& collision : link.collisions) {
    const auto radius = find_radius(collision.geometry);
    if (!radius) continue;
    striker.radius = std::min(*radius, striker.radius.value_or(*radius));
  }
  return striker;
}

Striker find_striker(const Scene& scene, const std::vector<LinkMotion>& motions,
                     const Toucher& body) {
  if (!body.is_obstacle) {
    return describe_link(scene.robot.links[body.index], motions[body.index]);
  }
  const ObstacleSpec& obstacle = scene.scenario.obstacles[body.index];
  return {.material = obstacle.material,
          .radius = find_radius(obstacle.geometry)};
}

// Of an anisotropic material, that of the stiffest surface across its axes.
contact::SurfaceMaterial find_surface(const flexbody::Material& material) {
  contact::SurfaceMaterial surface{material.youngs_modulus,
                                   material.poisson_ratio};
  if (!material.anisotropy) return surface;
  surface.youngs_modulus = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const SolidMaterial own = find_isotropic_surface(
        find_surface_compliance(material.anisotropy->C, Vector3::Unit(axis)));
    if (own.youngs_modulus > surface.youngs_modulus)
      surface = {own.youngs_modulus, own.poisson_ratio};
  }
  return surface;
}

// The stiffest of the link's materials, with the shortest impacts.
Material find_own_material(const FlexibleLink& flexible) {
  Material own;
  for (const flexbody::MaterialRegion& region : flexible.materials) {
    const contact::SurfaceMaterial material = find_surface(region.material);
    if (own && own->youngs_modulus >= material.youngs_modulus) continue;
    own = material;
  }
  return own;
}

std::optional<double> find_stiffness(const ContactOptions& options,
                                     const Material& own,
                                     const Striker& other) {
  if (options.stiffness) return options.stiffness;
  const auto radius = options.radius ? options.radius : other.radius;
  const auto moduli = contact::find_pair_moduli(own, other.material);
  if (!radius || !moduli) return std::nullopt;
  return contact::find_hertz_stiffness(moduli->normal, *radius);
}

}  // namespace

std::vector<flexbody::ExpectedImpact> find_expected_impacts(
    const Scene& scene, const std::vector<LinkMotion>& motions, int link) {
  const Toucher self{.index = static_cast<std::size_t>(link)};
  const Link& own = scene.robot.links[self.index];
  std::vector<flexbody::ExpectedImpact> impacts;
  for (const TouchingPair& pair : scene.touching) {
    if (!(pair.A == self) && !(pair.B == self)) continue;
    const Striker other =
        find_striker(scene, motions, pair.A == self ? pair.B : pair.A);
    const auto stiffness =
        find_stiffness(scene.scenario.contacts[pair.contact].options,
                       find_own_material(*own.flexible), other);
    const double speed = (other.v_W - motions[self.index].v_WL_W).norm();
    if (stiffness && speed > 0.0) {
      impacts.push_back({other.mass, *stiffness, speed});
    }
  }
  return impacts;
}

}  // namespace limber::scene
