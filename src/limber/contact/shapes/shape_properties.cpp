// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/shape_properties.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "limber/common/errors.hpp"
#include "limber/common/overloaded.hpp"
#include "limber/contact/law/check_value.hpp"
#include "limber/contact/shapes/mesh_surface.hpp"

namespace limber::contact {
namespace {

using SurfacePointer = std::shared_ptr<const MeshSurface>;

void check_size(const char* what, double value) {
  check_value(value > 0.0, what, value, "> 0");
}

void check_kind(const ShapeKind& kind) {
  std::visit(
      Overloaded{[](const Sphere& sphere) {
                   check_size("sphere's radius [m]", sphere.radius);
                 },
                 [](const Capsule& capsule) {
                   check_size("capsule's radius [m]", capsule.radius);
                   check_size("capsule's half length [m]", capsule.half_length);
                 },
                 [](const Cylinder& cylinder) {
                   check_size("cylinder's radius [m]", cylinder.radius);
                   check_size("cylinder's half length [m]",
                              cylinder.half_length);
                 },
                 [](const Cone& cone) {
                   check_size("cone's radius [m]", cone.radius);
                   check_size("cone's half length [m]", cone.half_length);
                 },
                 [](const Ellipsoid& body) {
                   for (const double radius : body.radii) {
                     check_size("ellipsoid's radius [m]", radius);
                   }
                 },
                 [](const Box& box) {
                   for (const double size : box.half_size) {
                     check_size("box's half size [m]", size);
                   }
                 },
                 [](const HalfSpace&) {},
                 [](const SurfacePointer& mesh_surface) {
                   if (mesh_surface != nullptr) return;
                   throw InputError("contact: its surface is missing");
                 }},
      kind);
}

// Largest distance of the shape's points from the origin of its frame.
double find_size(const ShapeKind& kind, const joints::PairBody& body) {
  return std::visit(
      Overloaded{[](const Sphere& sphere) { return sphere.radius; },
                 [](const Capsule& capsule) {
                   return capsule.half_length + capsule.radius;
                 },
                 [](const Cylinder& cylinder) {
                   return std::hypot(cylinder.half_length, cylinder.radius);
                 },
                 [](const Cone& cone) {
                   return std::hypot(cone.half_length, cone.radius);
                 },
                 [](const Ellipsoid& egg) { return egg.radii.maxCoeff(); },
                 [](const Box& box) { return box.half_size.norm(); },
                 [](const HalfSpace&) {
                   return std::numeric_limits<double>::infinity();
                 },
                 [&body](const SurfacePointer& mesh_surface) {
                   return mesh_surface->find_extent(
                       find_modal_coordinates(*mesh_surface, body));
                 }},
      kind);
}

}  // namespace

std::string name_kind(const Shape& shape) {
  return std::visit(Overloaded{[](const Sphere&) { return "sphere"; },
                               [](const Capsule&) { return "capsule"; },
                               [](const Cylinder&) { return "cylinder"; },
                               [](const Cone&) { return "cone"; },
                               [](const Ellipsoid&) { return "ellipsoid"; },
                               [](const Box&) { return "box"; },
                               [](const HalfSpace&) { return "half space"; },
                               [](const SurfacePointer&) { return "skin"; }},
                    shape.kind);
}

void check_shape(const Shape& shape) {
  check_kind(shape.kind);
  constexpr double kRoundOff = 1e-9;
  const Matrix3& R = shape.X_BS.R;
  const double error = (R.transpose() * R - Matrix3::Identity()).norm();
  if (!(error < kRoundOff) || !(R.determinant() > 0.0) ||
      !shape.X_BS.p.allFinite()) {
    throw InputError(fmt::format(
        "contact: the pose of its {} is not a rotation and a finite position",
        name_kind(shape)));
  }
  const bool is_at_body =
      shape.X_BS.p.isZero(0.0) && (R - Matrix3::Identity()).isZero(0.0);
  if (std::holds_alternative<SurfacePointer>(shape.kind) && !is_at_body) {
    throw InputError(
        "contact: its surface has its own pose; expected that of its body, in "
        "whose frame its nodes are given");
  }
}

int count_modes(const Shape& shape) {
  const auto* mesh_surface = std::get_if<SurfacePointer>(&shape.kind);
  return mesh_surface == nullptr ? 0 : (*mesh_surface)->mode_count();
}

double find_extent(const Shape& shape, const joints::PairBody& body) {
  return shape.X_BS.p.norm() + find_size(shape.kind, body);
}

}  // namespace limber::contact
