// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A shape at the pose of its body.
struct PlacedShape {
  PlacedShape(const Shape& shape_, const joints::PairBody& body_)
      : shape(shape_),
        body(body_),
        X_WB{body_.R_WB, body_.p_WB},
        X_WS(X_WB * shape_.X_BS) {}

  const Shape& shape;
  const joints::PairBody& body;
  Pose X_WB;
  Pose X_WS;

  /// A point in the shape's frame as a place of the body.
  [[nodiscard]] SurfacePlace make_place(const Vector3& x_S) const {
    return {.x_B = shape.X_BS * x_S};
  }
};

}  // namespace limber::contact
