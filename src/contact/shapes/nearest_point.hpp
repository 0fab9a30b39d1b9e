// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/types.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// The point of a smooth shape's surface that is nearest to a point p, all in
/// the shape's frame.
struct NearestPoint {
  double distance = 0.0;             ///< of p, < 0 inside [m]
  Vector3 point = Vector3::Zero();   ///< [m]
  Vector3 normal = Vector3::Zero();  ///< unit, outward: d distance / dp [-]
  double curvature = 0.0;            ///< mean curvature there, 0 on edges [1/m]
};

/// If several points are nearest, as to the centre of a sphere, one of them,
/// always the same.
[[nodiscard]] NearestPoint find_nearest(const Sphere& shape, const Vector3& p);
[[nodiscard]] NearestPoint find_nearest(const Capsule& shape, const Vector3& p);
[[nodiscard]] NearestPoint find_nearest(const HalfSpace& shape,
                                        const Vector3& p);

}  // namespace limber::contact
