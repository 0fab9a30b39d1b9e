// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/analysis/group_lengths.hpp"
#include "limber/dynamics/equations/equations.hpp"
#include "limber/dynamics/newton/newton_matrix.hpp"

namespace limber::dynamics {

/// Newton's method for a system at rest, used by find_equilibrium. Costs about
/// one force evaluation per Krylov vector: O(bodies).
class StaticNewton {
 public:
  struct Settings {
    double tolerance = 1e-12;  ///< last correction over the extents [-]
    int max_iterations = 20;   ///< count
  };

  /// @param start at rest
  StaticNewton(const SystemModel& model, const SystemState& start);

  /// Unbalanced forces at `state`, at rest, with the wrenches of the couplers'
  /// laws; rows as increments of NewtonMatrix, opposite sign.
  [[nodiscard]] const VectorX& calc_forces_left(const SystemState& state);
  [[nodiscard]] const SystemTerms& terms() const { return terms_; }

  /// The preconditioner's correction at `state`, by lengths().measure:
  /// round-off if forces balance [-].
  [[nodiscard]] double measure_slow_step(const SystemState& state);

  /// Moves `state` to where calc_forces_left is `target`.
  /// @returns whether it converged; if not, `state` is invalid.
  bool solve(const VectorX& target, const Settings& settings,
             SystemState& state);

  [[nodiscard]] int iterations() const { return iterations_; }
  [[nodiscard]] const GroupLengths& lengths() const { return lengths_; }
  /// Body that the last correction moved most.
  [[nodiscard]] BodyIndex most_moved() const;

 private:
  void evaluate(const SystemState& state, WrenchSource source,
                SystemTerms& terms, VectorX& residual) const;
  void factor(const SystemState& state);
  bool correct(const SystemState& state, const VectorX& right,
               double tolerance);
  VectorX apply(const SystemState& state, const VectorX& direction);

  const SystemModel& model_;
  GroupLengths lengths_;
  double slowness_ = 0.0;  ///< coefficient of acceleration [1/s^2]
  VectorX no_motion_;
  SystemTerms terms_;   ///< at the iterate
  SystemTerms probed_;  ///< near it
  NewtonMatrix matrix_;
  VectorX wrenches_;  ///< acting: six per coupler, one per transmission
  VectorX changes_;   ///< of the laws along a motion
  VectorX laws_;      ///< the same by the laws
  VectorX residual_;  ///< of the laws
  VectorX base_;      ///< of the wrenches
  VectorX correction_;
  int iterations_ = 0;
};

}  // namespace limber::dynamics
