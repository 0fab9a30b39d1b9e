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

NearestPoint find_nearest(const Cylinder& shape, const Vector3& p) {
  const double side = std::hypot(p.x(), p.y());
  const Vector3 radial =
      side > 0.0 ? Vector3(p.x() / side, p.y() / side, 0.0) : Vector3::UnitX();
  const Vector3 axial(0.0, 0.0, p.z() < 0.0 ? -1.0 : 1.0);
  const double beyond_side = side - shape.radius;
  const double beyond_end = std::abs(p.z()) - shape.half_length;
  if (beyond_side > 0.0 && beyond_end > 0.0) {
    const double distance = std::hypot(beyond_side, beyond_end);
    return {.distance = distance,
            .point = shape.radius * radial + shape.half_length * axial,
            .normal = (beyond_side * radial + beyond_end * axial) / distance,
            .curvature = 0.0};
  }
  if (beyond_side > beyond_end) {
    return {.distance = beyond_side,
            .point = p - beyond_side * radial,
            .normal = radial,
            .curvature = 0.5 / shape.radius};
  }
  return {.distance = beyond_end,
          .point = p - beyond_end * axial,
          .normal = axial,
          .curvature = 0.0};
}

NearestPoint find_nearest(const Box& shape, const Vector3& p) {
  const Vector3& h = shape.half_size;
  const Vector3 beyond = p.cwiseAbs() - h;
  if ((beyond.array() > 0.0).any()) {
    const Vector3 point = p.cwiseMax(-h).cwiseMin(h);
    const Vector3 arm = p - point;
    const double distance = arm.norm();
    return {.distance = distance,
            .point = point,
            .normal = arm / distance,
            .curvature = 0.0};
  }
  int axis = 0;
  const double distance = beyond.maxCoeff(&axis);
  Vector3 normal = Vector3::Zero();
  normal[axis] = p[axis] < 0.0 ? -1.0 : 1.0;
  return {.distance = distance,
          .point = p - distance * normal,
          .normal = normal,
          .curvature = 0.0};
}

NearestPoint find_nearest(const HalfSpace& /*shape*/, const Vector3& p) {
  return {.distance = p.z(),
          .point = Vector3(p.x(), p.y(), 0.0),
          .normal = Vector3::UnitZ(),
          .curvature = 0.0};
}

}  // namespace limber::contact
