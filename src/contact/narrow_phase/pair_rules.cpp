// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/pair_rules.hpp"

#include <algorithm>
#include <optional>

#include "limber/contact/shapes/nearest_point.hpp"
#include "limber/contact/shapes/skin.hpp"

namespace limber::contact {
namespace {

using SkinPointer = std::shared_ptr<const Skin>;

// A point of B's surface in B's frame, and its place.
struct NearestOnSurface {
  NearestPoint point;
  SurfacePlace place;
};

std::optional<NearestOnSurface> find_nearest_of(const PlacedShape& B,
                                                const Vector3& p, double radius,
                                                double reach) {
  return std::visit(
      [&](const auto& shape) -> std::optional<NearestOnSurface> {
        using Kind = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Kind, SkinPointer>) {
          const auto hit =
              shape->find_nearest(p, find_modal_coordinates(*shape, B.body),
                                  reach + radius, radius);
          if (!hit) return std::nullopt;
          return NearestOnSurface{hit->nearest, hit->place};
        } else if constexpr (std::is_same_v<Kind, Box> ||
                             std::is_same_v<Kind, Cylinder>) {
          return std::nullopt;  // not of this rule
        } else {
          const NearestPoint point = find_nearest(shape, p);
          return NearestOnSurface{point, B.make_place(point.point)};
        }
      },
      B.shape.kind);
}

}  // namespace

Meeting meet_sphere(const PlacedShape& A, const PlacedShape& B, double reach) {
  const double radius = std::get<Sphere>(A.shape.kind).radius;
  const Vector3 centre = B.X_WS.inverse() * A.X_WS.p;
  const auto nearest = find_nearest_of(B, centre, radius, reach);
  if (!nearest) return {};
  const NearestPoint& on_B = nearest->point;
  const Vector3 normal_W = -(B.X_WS.R * on_B.normal);
  const double depth = radius - on_B.distance;
  return {.depth = depth,
          .normal_W = normal_W,
          .p_W = B.X_WS * (on_B.point - 0.5 * depth * on_B.normal),
          .on_A = A.make_place(radius * (A.X_WS.R.transpose() * normal_W)),
          .on_B = nearest->place,
          .curvature = std::max(0.0, 1.0 / radius + on_B.curvature)};
}

double find_sphere_clearance(const PlacedShape& A, const PlacedShape& B) {
  const double radius = std::get<Sphere>(A.shape.kind).radius;
  if (const auto* skin = std::get_if<SkinPointer>(&B.shape.kind)) {
    return (*skin)->find_clearance(B.X_WS.inverse() * A.X_WS.p, radius,
                                   find_modal_coordinates(**skin, B.body));
  }
  return -meet_sphere(A, B, 0.0).depth;
}

}  // namespace limber::contact
