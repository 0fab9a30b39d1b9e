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
  DepthField A_;
  DepthField B_;
};

}  // namespace limber::contact
