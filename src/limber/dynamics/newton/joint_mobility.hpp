// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/newton/newton_matrix.hpp"
#include "limber/joints/pairs/pair_mobility.hpp"

namespace limber::dynamics {

/// Mobility of bodies in contact that are connected by joints.
///
/// Equation   Y = w^2 (w^2 M + w D + K)^-1, at the rows of both bodies, K and D
///            of couplers and modes and w the frequency of the impact: what is
///            much stiffer holds as a constraint, what is much softer not at
///            all
/// Source     inverse of the operational space inertia [@khatib1987]
/// Limits     of frames, without what modes add at the place of contact; other
///            contacts do not act; allocates when it is made alone
class JointMobility {
 public:
  JointMobility() = default;
  explicit JointMobility(const SystemModel& model);

  /// Whether anything but contacts joins one of the pair's bodies to others.
  /// Not in systems with unreduced bodies.
  [[nodiscard]] bool is_joined(std::size_t pair) const {
    return is_joined_[pair] != 0;
  }
  /// @param frequency w > 0 [rad/s]
  /// @throws NumericalError naming the coupler or body.
  [[nodiscard]] joints::PairMobility find(const SystemModel& model,
                                          const SystemState& state,
                                          std::size_t pair, double frequency);

 private:
  std::vector<char> is_joined_;  // of pairs
  SystemTerms terms_;
  NewtonMatrix matrix_;
  VectorX no_motion_;
  std::vector<Vector6> no_gaps_;
  VectorX residual_;
  VectorX increments_;
};

}  // namespace limber::dynamics
