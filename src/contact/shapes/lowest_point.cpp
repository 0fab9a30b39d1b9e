// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/lowest_point.hpp"

#include <cmath>

#include "limber/contact/shapes/convex_core.hpp"

namespace limber::contact {

Vector3 find_lowest_round(const PlacedShape& body, const Vector3& up,
                          double level) {
  const ConvexCore core(body);
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
