// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/lowest_point.hpp"

#include <cmath>

#include "limber/contact/shapes/convex_core.hpp"

namespace limber::contact {

namespace {

Vector3 find_lowest_of_cone(const Cone& cone, const Pose& X, const Vector3& up,
                            double level) {
  const Vector3 axis = X.R.col(2);
  const double slope = up.dot(axis);
  const Vector3 tip = X.p + cone.half_length * axis;
  Vector3 low = X.p - cone.half_length * axis;
  const Vector3 across = up - slope * axis;
  if (across.norm() > level) low -= cone.radius * across.normalized();
  const Vector3 edge = tip - low;
  const double rise = up.dot(edge);
  if (std::abs(rise) <= level * edge.norm()) return low + 0.5 * edge;
  return rise < 0.0 ? tip : low;
}

}  // namespace

Vector3 find_lowest_round(const PlacedShape& body, const Vector3& up,
                          double level) {
  if (const auto* cone = std::get_if<Cone>(&body.shape.kind)) {
    return find_lowest_of_cone(*cone, body.X_WS, up, level);
  }
  const ConvexCore core(body);
  if (core.segments().empty()) return core.find_support_point(-up);
  const ConvexCore::Segment& segment = core.segments().front();
  const double slope = up.dot(segment.axis);
  Vector3 lowest = core.centre() - core.ball() * up;
  if (std::abs(slope) > level) {
    lowest -= std::copysign(segment.half_length, slope) * segment.axis;
  }
  const Vector3 across = up - slope * segment.axis;
  if (across.norm() > level) lowest -= core.disc() * across.normalized();
  return lowest;
}

}  // namespace limber::contact
