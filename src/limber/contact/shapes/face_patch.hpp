// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "limber/common/types.hpp"

namespace limber::contact {

/// A place on a triangular face: u and v are the weights of its corners 1 and
/// 2, in the triangle u, v >= 0, u + v <= 1 [-].
struct FacePlace {
  double u = 0.0;
  double v = 0.0;

  [[nodiscard]] std::array<double, 3> weights() const {
    return {1.0 - u - v, u, v};
  }
};

/// The corners 0, 1, 2 of a face.
inline constexpr std::array<FacePlace, 3> kFaceCorners = {
    {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};

/// The surface of a straight or quadratic triangle.
///
/// Equation   x(u,v) = sum_i N_i(u,v) X_i, with the shape functions of the
///            triangle of 3 or 6 nodes, kept as a polynomial in u and v
class FacePatch {
 public:
  /// A straight face. @param X its corners [m]
  explicit FacePatch(const std::array<Vector3, 3>& X);
  /// A quadratic face. @param X its corners, then its mid-edge nodes [m]
  explicit FacePatch(const std::array<Vector3, 6>& X);

  [[nodiscard]] Vector3 find_point(const FacePlace& at) const {
    return x_ + at.u * (x_u_ + 0.5 * at.u * x_uu_ + at.v * x_uv_) +
           at.v * (x_v_ + 0.5 * at.v * x_vv_);
  }
  [[nodiscard]] Vector3 find_tangent_u(const FacePlace& at) const {
    return x_u_ + at.u * x_uu_ + at.v * x_uv_;
  }
  [[nodiscard]] Vector3 find_tangent_v(const FacePlace& at) const {
    return x_v_ + at.u * x_uv_ + at.v * x_vv_;
  }
  /// Not of unit length.
  [[nodiscard]] Vector3 find_normal(const FacePlace& at) const {
    return find_tangent_u(at).cross(find_tangent_v(at));
  }
  /// Half the sum of the principal curvatures, convex > 0; 0 where the face has
  /// no normal [1/m].
  ///
  /// Equation   -(E N - 2 F M + G L) / (2 (E G - F^2)), of the first and the
  ///            second fundamental form
  /// Source     [@docarmo1976, sec. 3-3]
  [[nodiscard]] double find_mean_curvature(const FacePlace& at) const;

  /// An upper bound of the distance of the patch from the four flat triangles
  /// between its nodes [m].
  [[nodiscard]] double find_bulge() const;

  struct FlatNearest {
    FacePlace at;
    double square = 0.0;  ///< of the distance [m^2]
  };
  /// The point of those flat triangles (the face itself if it is straight) that
  /// is nearest to p.
  [[nodiscard]] FlatNearest find_nearest_of_flat(const Vector3& p) const;
  /// The point of the patch nearest to p, by Newton's method from a place close
  /// to it; a local minimum of the distance within the triangle.
  [[nodiscard]] FacePlace find_nearest(const Vector3& p,
                                       const FacePlace& start) const;

  [[nodiscard]] bool is_straight() const { return is_straight_; }

 private:
  // x and its derivatives at u = v = 0.
  Vector3 x_;
  Vector3 x_u_;
  Vector3 x_v_;
  Vector3 x_uu_ = Vector3::Zero();
  Vector3 x_uv_ = Vector3::Zero();
  Vector3 x_vv_ = Vector3::Zero();
  bool is_straight_;
};

/// The weights of a face's nodes at a place; the last three are 0 for a
/// straight face [-].
[[nodiscard]] std::array<double, 6> find_shape_functions(const FacePlace& at,
                                                         bool is_straight);

}  // namespace limber::contact
