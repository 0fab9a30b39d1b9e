// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/common/pose.hpp"
#include "limber/contact/potential/body_kind.hpp"
#include "limber/contact/potential/patch.hpp"

namespace limber::contact {

/// Two balls, or a ball and a half space, which touch at a point.
///
/// Equation   W = 2/5 k d^(5/2), k = 4/3 E* sqrt(R_e), of the pressure
///            sqrt(1 - r^2 / (R_e d)) on a disc midway between both surfaces
/// Source     Hertz: [@johnson1985, ch. 4]
class HertzPair {
 public:
  /// @param modulus E* > 0 [Pa]
  /// @throws ContractError unless suits(A, B).
  HertzPair(const BodyKind& A, const BodyKind& B, double modulus);

  [[nodiscard]] static bool suits(const BodyKind& A, const BodyKind& B);

  /// In the axes and from the origin of both poses.
  [[nodiscard]] Patch evaluate(const Pose& X_A, const Pose& X_B) const;

 private:
  double curvature_A_;  // 0 of a half space [1/m]
  double curvature_B_;
  double radius_;     // R_e [m]
  double stiffness_;  // k [N/m^1.5]
};

}  // namespace limber::contact
