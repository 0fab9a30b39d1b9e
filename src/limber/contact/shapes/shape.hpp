// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <variant>

#include "limber/common/pose.hpp"
#include "limber/common/types.hpp"

namespace limber::contact {

class MeshSurface;

/// Shapes, each about the origin of its own frame.
struct Sphere {
  double radius = 0.0;  ///< > 0 [m]
};
/// All points within `radius` of the segment |z| <= half_length of its z axis.
struct Capsule {
  double radius = 0.0;       ///< > 0 [m]
  double half_length = 0.0;  ///< > 0 [m]
};
/// x^2 + y^2 <= radius^2, |z| <= half_length.
struct Cylinder {
  double radius = 0.0;       ///< > 0 [m]
  double half_length = 0.0;  ///< > 0 [m]
};
/// From a disc at z = -half_length to a tip at z = half_length.
struct Cone {
  double radius = 0.0;       ///< of the disc, > 0 [m]
  double half_length = 0.0;  ///< > 0 [m]
};
struct Ellipsoid {
  Vector3 radii = Vector3::Zero();  ///< along x, y and z, > 0 [m]
};
struct Box {
  Vector3 half_size = Vector3::Zero();  ///< > 0 [m]
};
/// z <= 0.
struct HalfSpace {};

using ShapeKind =
    std::variant<Sphere, Capsule, Cylinder, Box, HalfSpace,
                 std::shared_ptr<const MeshSurface>, Cone, Ellipsoid>;

/// A shape attached to a body. A MeshSurface deforms with the body's modes; all
/// others move with its frame.
struct Shape {
  ShapeKind kind;
  Pose X_BS;  ///< the shape's frame in the body frame; identity for a
              ///< MeshSurface
};

/// A material point of a shape's surface.
struct SurfacePlace {
  Vector3 x_B = Vector3::Zero();  ///< undeformed, body frame [m]
  int face = -1;                  ///< of a MeshSurface
  double u = 0.0;                 ///< weight of the face's corner 1 [-]
  double v = 0.0;                 ///< weight of its corner 2 [-]
};

}  // namespace limber::contact
