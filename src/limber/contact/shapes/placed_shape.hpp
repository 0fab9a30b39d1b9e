// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/shapes/shape.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// A shape at the pose of its body.
struct PlacedShape {
  PlacedShape(const Shape& shape_, const joints::PairBody& body)
      : shape(shape_), X_WS(Pose{body.R_WB, body.p_WB} * shape_.X_BS) {}

  const Shape& shape;
  Pose X_WS;
};

}  // namespace limber::contact
