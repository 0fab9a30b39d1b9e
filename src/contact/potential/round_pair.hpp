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

/// Two bodies of which one is round: a cylinder with a half space, a box or a
/// cylinder, of which each is the soft one in turn; or a capsule or ball,
/// always the soft one, whose moments count for both.
///
/// Equation   factor of W: find_shape_factor times c; c = 1, with a ball or
///            capsule k = 0.8433, exact for a ball on a flat, of two cylinders
///            1 - (1 - k) x / (x + 0.01), x the square sine between their axes
/// Limits     forces of a lying cylinder are 5 % too large, of a lying capsule
///            12 % too small
class RoundPair {
 public:
  /// @throws ContractError unless suits(A, B).
  RoundPair(const ShapeKind& A, const ShapeKind& B);

  /// Smooth bodies touch at points, of which other laws are exact: they do not
  /// suit, nor do two bodies with flat faces alone.
  [[nodiscard]] static bool suits(const ShapeKind& A, const ShapeKind& B);

  /// Nothing if they are apart.
  [[nodiscard]] std::optional<PairMoments> find_moments(
      const Pose& X_A, const Pose& X_B, bool has_derivatives) const;

 private:
  // c of the pair of kinds
  [[nodiscard]] Factor find_factor(const Pose& X_A, const Pose& X_B) const;

  DepthField A_;
  DepthField B_;
};

}  // namespace limber::contact
