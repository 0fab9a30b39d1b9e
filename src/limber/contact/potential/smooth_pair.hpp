// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/potential/body_kind.hpp"
#include "limber/contact/potential/patch.hpp"

namespace limber::contact {

/// An ellipsoid and a half space, ball, capsule or ellipsoid, which touch at a
/// point.
///
/// Equation   W = 2/5 k d^(5/2); d = h_A(n) + h_B(-n) - n . (p_B - p_A), h the
///            support functions, the least one of all unit n, so that n is
///            normal to both surfaces; k = 4/3 E* sqrt(R_e) F of Hertz's
///            ellipse, R_e = det(K)^(-1/2), K the sum of both curvatures where
///            the normals are n: each the inverse of the second derivative of
///            h across n. By a capsule, k passes from its side to an end as
///            that of BallOnCapsule, whose W this is if all radii are the same:
///            the place on its axis is L + n . u det(P) / P_tt beyond the end
///            at L, P = h_B'' + (r - d) I, t across the axis u and n.
///            W's derivatives are exact, of the touch's as well: n follows the
///            motion by Newton's method on its expansion to second order
/// Source     Hertz: [@johnson1985, ch. 4]
/// Limits     the gradient jumps by the order of d over the radii where a touch
///            goes from the side of a capsule to an end; spread_W is that of a
///            round area of Hertz's R_e
class SmoothPair {
 public:
  /// @param modulus E* > 0 [Pa] @throws ContractError unless suits(A, B).
  SmoothPair(const BodyKind& A, const BodyKind& B, double modulus);

  [[nodiscard]] static bool suits(const BodyKind& A, const BodyKind& B);

  /// In the axes and from the origin of both poses.
  [[nodiscard]] Patch evaluate(const Pose& X_A, const Pose& X_B) const;

 private:
  // A half space, or all within an ellipsoid of a segment.
  struct Other {
    bool is_plane = false;
    Vector3 radii = Vector3::Zero();
    double half_length = 0.0;  // along z
  };
  class Touch;

  // Of the ellipsoid as B.
  [[nodiscard]] Patch press(const Pose& X_A, const Pose& X_B) const;

  bool is_ellipsoid_first_ = false;
  Other other_;
  Ellipsoid ellipsoid_;
  double modulus_;
};

}  // namespace limber::contact
