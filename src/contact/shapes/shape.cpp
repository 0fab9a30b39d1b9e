// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape.hpp"

#include "limber/common/overloaded.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {

std::string name_kind(const Shape& shape) {
  return std::visit(
      Overloaded{[](const Sphere&) { return "sphere"; },
                 [](const Capsule&) { return "capsule"; },
                 [](const Cylinder&) { return "cylinder"; },
                 [](const Box&) { return "box"; },
                 [](const HalfSpace&) { return "half space"; },
                 [](const std::shared_ptr<const Skin>&) { return "skin"; }},
      shape.kind);
}

void check_shape(const Shape& /*shape*/) {}

int count_modes(const Shape& shape) {
  const auto* skin = std::get_if<std::shared_ptr<const Skin>>(&shape.kind);
  return skin == nullptr ? 0 : (*skin)->mode_count();
}

void set_shape_functions(const Shape& /*shape*/, const SurfacePlace& /*place*/,
                         Matrix3X& out) {
  out.setZero();
}

double find_residual(const Shape& /*shape*/, const SurfacePlace& /*place*/) {
  return 0.0;
}

double find_extent(const Shape& /*shape*/, const joints::PairBody& /*body*/) {
  return 0.0;
}

}  // namespace limber::contact
