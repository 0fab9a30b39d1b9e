// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "limber/common/types.hpp"
#include "limber/contact/potential/ball_on_capsule.hpp"
#include "limber/contact/potential/capsule_pair.hpp"
#include "limber/contact/potential/depth_moments.hpp"
#include "limber/contact/potential/hertz_pair.hpp"
#include "limber/contact/potential/patch.hpp"
#include "limber/contact/potential/round_pair.hpp"
#include "limber/contact/potential/smooth_pair.hpp"
#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::contact {

/// Elastic contact of two convex bodies as one potential of their relative
/// pose: no rule depends on which feature is nearest.
///
/// Equation   W = f E* / sqrt(pi) sqrt(M) of each body's depth; their mean.
///            A flat of area S pressed in by d has N = 2 E* sqrt(S / pi) d,
///            that of a round punch [@johnson1985]; f = 1 of polyhedra, else of
///            RoundPair; of balls as HertzPair and BallOnCapsule, of
///            ellipsoids as SmoothPair, of two capsules as CapsulePair
/// Limits     two feet far apart are as stiff as one of their area
class PairPotential {
 public:
  /// @param modulus E* > 0 [Pa]
  /// @throws ContractError unless suits(A.kind, B.kind).
  PairPotential(const PlacedBody& A, const PlacedBody& B, double modulus);
  PairPotential(const Shape& A, const Shape& B, double modulus);

  /// @param has_derivatives else hessian_W of polyhedra is zero
  /// @param shift_W of B from its place [m]
  [[nodiscard]] Patch evaluate(const joints::PairBodies& bodies,
                               bool has_derivatives,
                               const Vector3& shift_W = Vector3::Zero()) const;

  [[nodiscard]] double modulus() const { return modulus_; }
  /// Whether a ball or ellipsoid touches something smooth.
  [[nodiscard]] bool is_point() const {
    return point_.has_value() || on_capsule_.has_value() || smooth_.has_value();
  }

  /// Two solids, one of them bounded, two capsules, or as RoundPair, HertzPair,
  /// BallOnCapsule or SmoothPair.
  [[nodiscard]] static bool suits(const BodyKind& A, const BodyKind& B);

 private:
  // From the origin of both shapes' poses.
  [[nodiscard]] Patch press(const Pose& X_A, const Pose& X_B,
                            bool has_derivatives) const;
  [[nodiscard]] Patch press_capsules(const Pose& X_A, const Pose& X_B,
                                     bool has_derivatives) const;
  [[nodiscard]] std::optional<PairMoments> find_moments(
      const Pose& X_A, const Pose& X_B, bool has_derivatives) const;
  [[nodiscard]] std::optional<PairMoments> find_flat_moments(
      Pose X_A, Pose X_B, bool has_derivatives) const;

  std::optional<ConvexSolid> A_;
  std::optional<ConvexSolid> B_;
  std::optional<RoundPair> round_;
  std::optional<CapsulePair> capsules_;
  std::optional<HertzPair> point_;
  std::optional<BallOnCapsule> on_capsule_;
  std::optional<SmoothPair> smooth_;
  // See Patch, in the bodies' frames.
  Matrix3 turns_A_ = Matrix3::Identity();
  Matrix3 turns_B_ = Matrix3::Identity();
  bool is_B_bounded_;
  Pose X_AS_;
  Pose X_BS_;
  double modulus_;
};

}  // namespace limber::contact
