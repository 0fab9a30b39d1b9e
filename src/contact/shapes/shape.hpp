// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "limber/common/pose.hpp"
#include "limber/common/types.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

class Skin;

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
struct Box {
  Vector3 half_size = Vector3::Zero();  ///< > 0 [m]
};
/// z <= 0.
struct HalfSpace {};

using ShapeKind = std::variant<Sphere, Capsule, Cylinder, Box, HalfSpace,
                               std::shared_ptr<const Skin>>;

/// A shape that a body carries. A Skin deforms with the body's modes; all
/// others move with its frame.
struct Shape {
  ShapeKind kind;
  Pose X_BS;  ///< the shape's frame in the body frame; identity for a Skin
};

/// A material point of a shape's surface.
struct SurfacePlace {
  Vector3 x_B = Vector3::Zero();  ///< undeformed, body frame [m]
  int face = -1;                  ///< of a Skin
  double u = 0.0;                 ///< weight of the face's corner 1 [-]
  double v = 0.0;                 ///< weight of its corner 2 [-]
};

/// In words, such as "half space".
[[nodiscard]] std::string name_kind(const Shape& shape);

/// @throws InputError if a size is not positive and finite, the pose is no
/// rigid one, or a Skin is missing or not at the body's own frame.
void check_shape(const Shape& shape);

/// Modes of the body that move the shape: 0 but for a Skin.
[[nodiscard]] int count_modes(const Shape& shape);

/// The modes' rows at a place of a shape: it is at x_B + out eta. All zero for
/// a shape that does not deform. Allocates nothing.
/// @param out 3 x m of the body [kg^-1/2]
/// @throws ContractError if a Skin has another number of modes.
void set_shape_functions(const Shape& shape, const SurfacePlace& place,
                         Matrix3X& out);

/// Displacement per force on the place that the modes leave out, 0 for shapes
/// that do not deform [m/N].
[[nodiscard]] double find_residual(const Shape& shape,
                                   const SurfacePlace& place);

/// An upper bound of the distance of the shape's points from Bo, as the body
/// is deformed; infinite for a half space [m].
[[nodiscard]] double find_extent(const Shape& shape,
                                 const joints::PairBody& body);

}  // namespace limber::contact
