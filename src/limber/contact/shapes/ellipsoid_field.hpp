// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/contact/shapes/line_cuts.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// How deep a point is below the surface of an ellipsoid, in its own frame.
///
/// Equation   the nearest point y_i = r_i^2 x_i / (r_i^2 + s), s by Newton's
///            method on 1 / sqrt(F), F = sum (r_i x_i / (r_i^2 + s))^2 = 1;
///            flux phi grad t, phi = int_0^t 4 u^3 J(u) du / J(t), J(u) = 1 -
///            2 H u + K u^2 of the curvatures at y
/// Limits     of points nearer to the surface than its centres of curvature
class EllipsoidField {
 public:
  explicit EllipsoidField(const Ellipsoid& shape)
      : radii_(shape.radii), inverse_(shape.radii.cwiseInverse()) {}

  [[nodiscard]] Depth find_depth(const Vector3& x) const;
  /// Of the sign of t, not larger, and changing no faster than t: (1 - |x_i /
  /// r_i|) times the least radius, t of a ball [m].
  [[nodiscard]] double find_bound(const Vector3& x) const {
    return radii_.minCoeff() * (1.0 - inverse_.cwiseProduct(x).norm());
  }
  /// v of the largest find_bound along a line.
  [[nodiscard]] double find_deepest(const StraightLine& line) const;
  [[nodiscard]] Span cut(const StraightLine& line) const;

 private:
  Vector3 radii_;
  Vector3 inverse_;
};

}  // namespace limber::contact
