// SPDX-License-Identifier: BSD-3-Clause
#include "limber/scene/contacts/contact_shapes.hpp"

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"

namespace limber::scene {

contact::ShapeKind make_shape(const Geometry& geometry) {
  LIMBER_EXPECT(!std::holds_alternative<MeshGeometry>(geometry));
  LIMBER_EXPECT(!std::holds_alternative<OtherGeometry>(geometry));
  using contact::ShapeKind;
  return std::visit(
      Overloaded{[](const SphereGeometry& g) -> ShapeKind {
                   return contact::Sphere{g.radius};
                 },
                 [](const BoxGeometry& g) -> ShapeKind {
                   return contact::Box{0.5 * g.size};
                 },
                 [](const CylinderGeometry& g) -> ShapeKind {
                   return contact::Cylinder{g.radius, 0.5 * g.length};
                 },
                 [](const CapsuleGeometry& g) -> ShapeKind {
                   return contact::Capsule{g.radius, 0.5 * g.length};
                 },
                 [](const ConeGeometry& g) -> ShapeKind {
                   return contact::Cone{g.radius, 0.5 * g.length};
                 },
                 [](const EllipsoidGeometry& g) -> ShapeKind {
                   return contact::Ellipsoid{g.radii};
                 },
                 [](const auto&) -> ShapeKind { return contact::HalfSpace{}; }},
      geometry);
}

contact::ContactParameters make_parameters(const ContactOptions& options) {
  contact::ContactParameters parameters;
  contact::FrictionLimit& friction = parameters.friction;
  friction.sliding = options.friction.value_or(friction.sliding);
  friction.excess =
      options.static_friction.value_or(friction.sliding) - friction.sliding;
  friction.speed = options.stribeck_speed.value_or(friction.speed);
  parameters.rolling_friction =
      options.rolling_friction.value_or(parameters.rolling_friction);
  parameters.restitution = options.restitution.value_or(parameters.restitution);
  parameters.radius = options.radius;
  parameters.stiffness = options.stiffness;
  parameters.damping = options.damping;
  return parameters;
}

}  // namespace limber::scene
