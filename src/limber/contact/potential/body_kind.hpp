// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "limber/contact/potential/convex_solid.hpp"

namespace limber::contact {

/// A convex body in its own frame; boxes and half spaces are solids.
using BodyKind =
    std::variant<Sphere, Capsule, Cylinder, ConvexSolid, Cone, Ellipsoid>;

/// In the frame of a rigid body, or of a part of a flexible one.
struct PlacedBody {
  BodyKind kind;
  Pose X_BS;
};

/// @throws ContractError for a surface.
[[nodiscard]] BodyKind make_body(const ShapeKind& shape);

}  // namespace limber::contact
