// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/pose.hpp"
#include "limber/contact/shapes/shape.hpp"

namespace limber::contact {

/// W and its derivatives by a motion of B against A about `centre`, in one set
/// of axes, over E*.
struct CapsuleTouch {
  double energy = 0.0;                 ///< [m^3]
  Vector3 centre = Vector3::Zero();    ///< of pressure [m]
  Vector6 gradient = Vector6::Zero();  ///< [m^2, m^3]
  Matrix6 hessian = Matrix6::Zero();   ///< symmetric [m, m^2; m^2, m^3]
  Matrix3 spread = Matrix3::Zero();    ///< second moments of pressure [m^2]
  double depth = 0.0;                  ///< largest [m]
};

/// Two capsules, by one potential of their pose for sides, ends and lines.
///
/// Equation   the overlap of two thin lenses, in which each place s of one axis
///            meets each place u of the other: with t = R_A + R_B - |r|, r from
///            a(s) to b(u),
///            M_n = sqrt(R_A R_B) / (R_A + R_B) int int t^n (1 - (a . r)^2 /
///            r^2) (1 - (b . r)^2 / r^2) ds du, where an end continues as an
///            arc x of depth t - x^2 / (2 R) from the plane across its axis; W
///            = (8 / 15) sqrt(5 / (2 pi)) E* h sqrt(M_4), h of Hertz's ellipse
///            [@johnson1985] whose radii of curvature have the product and sum
///            of those that M_4, M_5 and the fractions of ends in M_4 give
/// Limits     depths small relative to the radii; the Hessian by differences
class CapsulePair {
 public:
  CapsulePair(const Capsule& A, const Capsule& B) : A_(A), B_(B) {}

  /// Nothing if they are apart.
  [[nodiscard]] std::optional<CapsuleTouch> find_touch(
      const Pose& X_A, const Pose& X_B, bool has_derivatives) const;

 private:
  // The gradient about a point, without the Hessian.
  [[nodiscard]] std::optional<CapsuleTouch> find_gradient(
      const Pose& X_A, const Pose& X_B) const;

  Capsule A_;
  Capsule B_;
};

}  // namespace limber::contact
