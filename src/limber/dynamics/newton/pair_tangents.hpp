// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/newton/lu_plan.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

namespace limber::dynamics {

/// Tangents of pairs that have points, in their bodies' increments.
///
/// Equation   of a pair: sum_i J_i' (K_i + v D_i) J_i
///            + sum_i sum_j J_i' coupling_ij J_j, d(p_B - p_A)_i = J_i x;
///            J = R_WB [R_BW, -arm x, Phi] of B's columns, minus that of A's
/// Limits     neglects the rotation of the force's arm, as NewtonMatrix
///            does
class PairTangents {
 public:
  PairTangents() = default;
  explicit PairTangents(const SystemModel& model);

  /// Uses the points of `terms`. @returns whether the set of pairs with points
  /// has changed
  bool update(const SystemTerms& terms);
  /// Whether pairs have as many points each as at the last update.
  [[nodiscard]] bool knows(const SystemTerms& terms) const;
  /// Pairs that have points.
  [[nodiscard]] std::vector<BodyPair> active(const SystemModel& model) const;

  /// Adds to the blocks of retained bodies. @param velocity per increment [1/s]
  /// @param end_terms as NewtonMatrix::factor's, or `terms`
  void add(const SystemModel& model, const SystemTerms& terms,
           const SystemTerms& end_terms, double velocity, LuPlan& plan);

 private:
  // A body's columns of all points: 3 rows a point, padded to sixes.
  struct Columns {
    MatrixX acting;
    MatrixX moving;
    MatrixX forces;  // (K + v D) moving
    int first = 0;   // row of the LU
    int blocks = 0;  // 0: the world
  };
  static void fill(const SystemModel& model, const Pair& pair, bool is_A,
                   const joints::PairResponse& response,
                   const SystemTerms& terms, const SystemTerms& end_terms,
                   double velocity, const LuPlan& plan, Columns& columns);
  static void add_coupling(const joints::PairResponse& response,
                           double velocity, Columns& columns);

  std::vector<std::size_t> counts_;  // points of each pair
  Columns A_;
  Columns B_;
};

}  // namespace limber::dynamics
