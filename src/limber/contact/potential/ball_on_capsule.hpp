// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/potential/body_kind.hpp"
#include "limber/contact/potential/patch.hpp"

namespace limber::contact {

/// A ball and a capsule, which touch at a point.
///
/// Equation   W = 2/5 k d^(5/2), d = R_A + R_B less the distance of the ball's
///            centre from the capsule's axis; k = 4/3 E* sqrt(R_e) at its
///            ends, and that of Hertz's ellipse on its side. Where the ball is
///            within w = sqrt(R_e d), the radius of the area, of where an end
///            begins, k changes from one to the other by a polynomial of fifth
///            degree in its place over w. W has a continuous gradient, of
///            which the forces are
/// Source     Hertz: [@johnson1985, ch. 4]
class BallOnCapsule {
 public:
  /// @param modulus E* > 0 [Pa] @throws ContractError unless suits(A, B).
  BallOnCapsule(const BodyKind& A, const BodyKind& B, double modulus);

  /// One of each.
  [[nodiscard]] static bool suits(const BodyKind& A, const BodyKind& B);

  /// In the axes and from the origin of both poses.
  [[nodiscard]] Patch evaluate(const Pose& X_A, const Pose& X_B) const;

 private:
  struct Stiffness;  // k and its derivatives
  [[nodiscard]] Stiffness find_stiffness(double z, double d) const;
  // Of the ball as B.
  [[nodiscard]] Patch press(const Pose& X_capsule, const Vector3& p) const;

  bool is_ball_first_;
  Sphere ball_;
  Capsule capsule_;
  double radius_;   // R_e at the ends [m]
  double of_end_;   // k [N/m^1.5]
  double of_side_;  // k [N/m^1.5]
  double
      flatness_;  // geometric mean of both radii of curvature on the side [m]
};

}  // namespace limber::contact
