// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/contact/potential/surface_moments.hpp"

namespace limber::contact {

/// Moments of each body's depth about one point, in one set of axes.
struct PairMoments {
  DepthMoments of_A;
  DepthMoments of_B;
  Vector3 o = Vector3::Zero();
};

/// Two bodies of which one is round: a cylinder or cone with a solid or one of
/// these, of which each is the soft one in turn; or a capsule, ball or
/// ellipsoid, always the soft one, whose moments count for both, as those of a
/// cylinder or cone do where some faces of the solid do not press, and those of
/// other solids beside a cone, whose own depth below a slender tip is small.
///
/// Equation   factor of W: find_shape_factor times c; c = 1, with a smooth one
///            k = 0.8433, exact for a ball on a flat, of two cylinders
///            1 - (1 - k) x / (x + 0.01), x the square sine between their axes,
///            with cones 1 - (1 - 0.8219) x / (x + 0.01), exact for a tip on a
///            half space, x the sum over cones of 2 (1 - f . a), f the way of
///            the force on it, a its axis: 0 of a disc that lies on a flat
/// Limits     forces of a lying cylinder are 5 % too large, of a lying capsule
///            12 % too small; on solids of which some faces do not press, tips
///            of the slope b are too soft by cos(b)^1.5
class RoundPair {
 public:
  /// @throws ContractError unless suits(A, B).
  RoundPair(const BodyKind& A, const BodyKind& B);

  /// Smooth bodies touch at points, of which other laws are exact: they do not
  /// suit, nor do two bodies with flat faces alone, nor solids of more than
  /// SolidField::kMostFaces.
  [[nodiscard]] static bool suits(const BodyKind& A, const BodyKind& B);

  /// Nothing if they are apart.
  [[nodiscard]] std::optional<PairMoments> find_moments(
      const Pose& X_A, const Pose& X_B, bool has_derivatives) const;

 private:
  [[nodiscard]] PairMoments integrate(const Pose& X_A, const Pose& X_B,
                                      const SurfaceContact* soft_A,
                                      const SurfaceContact* soft_B,
                                      bool has_derivatives) const;
  // c of the pair of kinds
  [[nodiscard]] Factor find_factor(const Pose& X_A, const Pose& X_B,
                                   const DepthMoments& moments) const;

  RuledBody A_;
  RuledBody B_;
};

}  // namespace limber::contact
