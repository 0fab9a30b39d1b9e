// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/narrow_phase/convex_core.hpp"

#include <cmath>

#include "limber/common/errors.hpp"

namespace limber::contact {

ConvexCore::ConvexCore(const PlacedShape& shape) : centre_(shape.X_WS.p) {
  const Matrix3& R = shape.X_WS.R;
  if (const auto* box = std::get_if<Box>(&shape.shape.kind)) {
    count_ = 3;
    for (int i = 0; i < 3; ++i) {
      segments_[static_cast<std::size_t>(i)] = {R.col(i), box->half_size[i]};
    }
    size_ = box->half_size.norm();
  } else if (const auto* rod = std::get_if<Cylinder>(&shape.shape.kind)) {
    segments_[0] = {R.col(2), rod->half_length};
    disc_ = rod->radius;
    size_ = std::hypot(rod->half_length, rod->radius);
  } else {
    const auto* capsule = std::get_if<Capsule>(&shape.shape.kind);
    LIMBER_EXPECT(capsule != nullptr);
    segments_[0] = {R.col(2), capsule->half_length};
    ball_ = capsule->radius;
    size_ = capsule->half_length;
  }
}

double ConvexCore::find_support(const Vector3& n) const {
  double support = 0.0;
  for (const Segment& segment : segments()) {
    support += segment.half_length * std::abs(n.dot(segment.axis));
  }
  if (disc_ > 0.0) support += disc_ * n.cross(segments_[0].axis).norm();
  return support;
}

Vector3 ConvexCore::find_support_point(const Vector3& n) const {
  Vector3 point = centre_;
  for (const Segment& segment : segments()) {
    const double side = n.dot(segment.axis) < 0.0 ? -1.0 : 1.0;
    point += side * segment.half_length * segment.axis;
  }
  if (disc_ > 0.0) {
    const Vector3& axis = segments_[0].axis;
    Vector3 radial = n - n.dot(axis) * axis;
    radial -= radial.dot(axis) * axis;  // or round-off would leave the disc
    const double length = radial.norm();
    if (length > 1e-12 * n.norm()) point += (disc_ / length) * radial;
  }
  return point;
}

Matrix3 ConvexCore::find_curvature(const Vector3& n) const {
  const Vector3 around = segments_[0].axis.cross(n);
  const double square = around.squaredNorm();
  if (!(disc_ > 0.0) || !(square > 0.0)) return Matrix3::Zero();
  return (disc_ / (square * std::sqrt(square))) * around * around.transpose();
}

}  // namespace limber::contact
