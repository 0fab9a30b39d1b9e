// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/shapes/placed_shape.hpp"

namespace limber::contact {

/// A ball, capsule, cylinder or box in the world frame as a Minkowski sum of
/// segments about its centre, a disc and a ball; or a hull of corners, a cone
/// or an ellipsoid, which have neither.
///
/// Equation   support max n . x = n . c + sum_k h_k |n . u_k|
///            + R |n x u_0| + r, n of unit length; of a cone the larger one of
///            its tip and its disc, of an ellipsoid n . c + |diag(radii) R' n|
class ConvexCore {
 public:
  struct Segment {
    Vector3 axis = Vector3::UnitZ();  ///< u, unit [-]
    double half_length = 0.0;         ///< h [m]
  };

  /// @throws ContractError for another kind of shape.
  explicit ConvexCore(const PlacedShape& shape);
  /// The hull of corners in a frame at X. @param corners that outlive it
  ConvexCore(std::span<const Vector3> corners, const Pose& X);

  /// Changes its size about its centre, without the ball. @param by > 0 [-]
  void scale(double by);

  [[nodiscard]] const Vector3& centre() const { return centre_; }
  /// Three for a box, otherwise one; of a ball its length is 0.
  [[nodiscard]] std::span<const Segment> segments() const {
    return std::span(segments_).first(count_);
  }
  /// R of the disc, normal to the first segment; 0: none [m].
  [[nodiscard]] double disc() const { return disc_; }
  /// r of the ball [m].
  [[nodiscard]] double ball() const { return ball_; }
  /// Largest distance of a point from the centre, without the ball [m].
  [[nodiscard]] double size() const { return size_; }

  /// A point of the set without the ball that is farthest along n, which may
  /// have any length [m].
  [[nodiscard]] Vector3 find_support_point(const Vector3& n) const;

 private:
  Vector3 centre_;
  std::array<Segment, 3> segments_;
  std::size_t count_ = 1;
  std::span<const Vector3> corners_;  // of a hull
  Matrix3 R_ = Matrix3::Identity();   // of the corners' frame, or an ellipsoid
  Vector3 origin_ = Vector3::Zero();
  double scale_ = 1.0;
  bool is_cone_ = false;  // whose disc is at the first segment's lower end
  Vector3 radii_ = Vector3::Zero();  // of an ellipsoid, along R_
  double disc_ = 0.0;
  double ball_ = 0.0;
  double size_ = 0.0;
};

}  // namespace limber::contact
