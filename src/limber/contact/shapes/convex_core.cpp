// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/shapes/convex_core.hpp"

#include <algorithm>
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
  } else if (const auto* cone = std::get_if<Cone>(&shape.shape.kind)) {
    segments_[0] = {R.col(2), cone->half_length};
    disc_ = cone->radius;
    is_cone_ = true;
    size_ = std::hypot(cone->half_length, cone->radius);
  } else if (const auto* egg = std::get_if<Ellipsoid>(&shape.shape.kind)) {
    count_ = 0;
    R_ = R;
    radii_ = egg->radii;
    size_ = radii_.maxCoeff();
  } else if (const auto* ball = std::get_if<Sphere>(&shape.shape.kind)) {
    ball_ = ball->radius;
  } else {
    const auto* capsule = std::get_if<Capsule>(&shape.shape.kind);
    LIMBER_EXPECT(capsule != nullptr);
    segments_[0] = {R.col(2), capsule->half_length};
    ball_ = capsule->radius;
    size_ = capsule->half_length;
  }
}

ConvexCore::ConvexCore(std::span<const Vector3> corners, const Pose& X)
    : count_(0), corners_(corners), R_(X.R), origin_(X.p) {
  LIMBER_EXPECT(!corners.empty());
  Vector3 sum = Vector3::Zero();
  for (const Vector3& corner : corners) sum += corner;
  const Vector3 middle = sum / static_cast<double>(corners.size());
  for (const Vector3& corner : corners) {
    size_ = std::max(size_, (corner - middle).norm());
  }
  centre_ = X * middle;
}

void ConvexCore::scale(double by) {
  for (Segment& segment : segments_) segment.half_length *= by;
  disc_ *= by;
  radii_ *= by;
  size_ *= by;
  origin_ += (1.0 - by) * (centre_ - origin_);
  scale_ *= by;
}

Vector3 ConvexCore::find_support_point(const Vector3& n) const {
  if (!corners_.empty()) {
    const Vector3 way = R_.transpose() * n;
    const auto farthest =
        std::max_element(corners_.begin(), corners_.end(),
                         [&way](const Vector3& a, const Vector3& b) {
                           return way.dot(a) < way.dot(b);
                         });
    return origin_ + scale_ * (R_ * *farthest);
  }
  if (!radii_.isZero(0.0)) {
    const Vector3 way = radii_.cwiseProduct(R_.transpose() * n);
    const double length = way.norm();
    if (!(length > 0.0)) return centre_;
    return centre_ + R_ * radii_.cwiseProduct(way / length);
  }
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
    Vector3 rim = Vector3::Zero();
    if (length > 1e-12 * n.norm()) rim = (disc_ / length) * radial;
    if (is_cone_) {
      const Vector3 tip = segments_[0].half_length * axis;
      return centre_ +
             (n.dot(rim) > 2.0 * n.dot(tip) ? Vector3(rim - tip) : tip);
    }
    point += rim;
  }
  return point;
}

}  // namespace limber::contact
