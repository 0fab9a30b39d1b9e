// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/nearest_point.hpp"

#include <algorithm>
#include <cmath>

namespace limber::contact {
namespace {

// Nearest point of the sphere about `centre`; `direction` is used if p is the
// centre.
NearestPoint find_on_ball(const Vector3& centre, double radius,
                          const Vector3& p, const Vector3& direction) {
  const Vector3 arm = p - centre;
  const double length = arm.norm();
  const Vector3 normal = length > 0.0 ? Vector3(arm / length) : direction;
  return {.distance = length - radius,
          .point = centre + radius * normal,
          .normal = normal,
          .curvature = 1.0 / radius};
}

}  // namespace

NearestPoint find_nearest(const Sphere& shape, const Vector3& p) {
  return find_on_ball(Vector3::Zero(), shape.radius, p, Vector3::UnitZ());
}

NearestPoint find_nearest(const Capsule& shape, const Vector3& p) {
  const double h = shape.half_length;
  const Vector3 centre(0.0, 0.0, std::clamp(p.z(), -h, h));
  NearestPoint nearest =
      find_on_ball(centre, shape.radius, p, Vector3::UnitX());
  if (std::abs(p.z()) < h) nearest.curvature *= 0.5;
  return nearest;
}

NearestPoint find_nearest(const HalfSpace& /*shape*/, const Vector3& p) {
  return {.distance = p.z(),
          .point = Vector3(p.x(), p.y(), 0.0),
          .normal = Vector3::UnitZ(),
          .curvature = 0.0};
}

}  // namespace limber::contact
