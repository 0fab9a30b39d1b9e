// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/potential/body_kind.hpp"

#include "limber/common/errors.hpp"

namespace limber::contact {

BodyKind make_body(const ShapeKind& shape) {
  if (is_solid(shape)) return ConvexSolid(shape);
  if (const auto* ball = std::get_if<Sphere>(&shape)) return *ball;
  if (const auto* capsule = std::get_if<Capsule>(&shape)) return *capsule;
  if (const auto* cone = std::get_if<Cone>(&shape)) return *cone;
  if (const auto* body = std::get_if<Ellipsoid>(&shape)) return *body;
  const auto* cylinder = std::get_if<Cylinder>(&shape);
  LIMBER_EXPECT(cylinder != nullptr);
  return *cylinder;
}

}  // namespace limber::contact
