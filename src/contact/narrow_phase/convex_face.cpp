// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/convex_face.hpp"

#include <cmath>
#include <numbers>

#include "limber/common/errors.hpp"

namespace limber::contact {
namespace {

// Cosine of the angle between a direction and an axis from which on the end of
// a cylinder or capsule faces the direction [-].
constexpr double kEndOn = std::numbers::sqrt2 / 2.0;

ConvexFace find_box_face(const PlacedShape& shape, const Box& box,
                         const Vector3& n) {
  const Vector3 n_S = shape.X_WS.R.transpose() * n;
  int axis = 0;
  n_S.cwiseAbs().maxCoeff(&axis);
  const double side = n_S[axis] < 0.0 ? -1.0 : 1.0;
  ConvexFace face;
  for (const auto& [i, j] : std::array<std::array<double, 2>, 4>{
           {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}}) {
    Vector3 corner;
    corner[axis] = side;
    corner[(axis + 1) % 3] = i;
    corner[(axis + 2) % 3] = j;
    face.add(shape.X_WS * box.half_size.cwiseProduct(corner));
  }
  return face;
}

// The direction normal to an axis that is farthest along n.
Vector3 find_radial(const PlacedShape& shape, const Vector3& n) {
  const Vector3 axis = shape.X_WS.R.col(2);
  const Vector3 radial = n - n.dot(axis) * axis;
  const double length = radial.norm();
  return length > 1e-9 ? Vector3(radial / length)
                       : Vector3(shape.X_WS.R.col(0));
}

ConvexFace find_cylinder_face(const PlacedShape& shape, const Cylinder& rod,
                              const Vector3& n) {
  const Vector3 axis = shape.X_WS.R.col(2);
  const Vector3 radial = find_radial(shape, n);
  const double along = n.dot(axis);
  ConvexFace face;
  if (std::abs(along) < kEndOn) {
    face.curvature = 0.5 / rod.radius;
    for (const double end : {1.0, -1.0}) {
      face.add(shape.X_WS.p + rod.radius * radial +
               end * rod.half_length * axis);
    }
    return face;
  }
  const Vector3 centre =
      shape.X_WS.p + (along < 0.0 ? -1.0 : 1.0) * rod.half_length * axis;
  const Vector3 side = axis.cross(radial);
  for (std::size_t i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi / 3.0 * static_cast<double>(i);
    face.add(centre +
             rod.radius * (std::cos(angle) * radial + std::sin(angle) * side));
  }
  return face;
}

ConvexFace find_capsule_face(const PlacedShape& shape, const Capsule& rod,
                             const Vector3& n) {
  const Vector3 axis = shape.X_WS.R.col(2);
  const double along = n.dot(axis);
  ConvexFace face;
  face.curvature = 1.0 / rod.radius;
  const Vector3 lift = rod.radius * n;
  if (std::abs(along) < kEndOn) {
    face.curvature = 0.5 / rod.radius;
    for (const double end : {1.0, -1.0}) {
      face.add(shape.X_WS.p + end * rod.half_length * axis + lift);
    }
    return face;
  }
  face.add(shape.X_WS.p + (along < 0.0 ? -1.0 : 1.0) * rod.half_length * axis +
           lift);
  return face;
}

}  // namespace

ConvexFace find_face(const PlacedShape& shape, const Vector3& n) {
  if (const auto* box = std::get_if<Box>(&shape.shape.kind)) {
    return find_box_face(shape, *box, n);
  }
  if (const auto* rod = std::get_if<Cylinder>(&shape.shape.kind)) {
    return find_cylinder_face(shape, *rod, n);
  }
  const auto* capsule = std::get_if<Capsule>(&shape.shape.kind);
  LIMBER_EXPECT(capsule != nullptr);
  return find_capsule_face(shape, *capsule, n);
}

std::size_t count_face_corners(const Shape& shape) {
  if (std::holds_alternative<Box>(shape.kind)) return 4;
  return std::holds_alternative<Cylinder>(shape.kind) ? 6 : 2;
}

}  // namespace limber::contact
