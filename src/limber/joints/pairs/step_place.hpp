// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/joints/pairs/pair_interaction.hpp"

namespace limber::joints {

/// Moves a place on a body so that the mean of its positions at both ends of a
/// step is its position in the middle.
///
/// Equation   x_B += ((R_0 + R_1) / 2)^-1 (p - (p_0 + p_1) / 2)
inline void centre_over_step(const PairBody& begin, const PairBody& middle,
                             const PairBody& end, PairPlace& place) {
  const Vector3 mean =
      0.5 * (find_position(begin, place) + find_position(end, place));
  const Matrix3 R = 0.5 * (begin.R_WB + end.R_WB);
  place.x_B += R.inverse() * (find_position(middle, place) - mean);
}

/// Both places of a point, which are one in the middle, then have one mean
/// position, where the forces of a step act: they keep angular momentum.
inline void centre_over_step(const PairStep& step, PairPoint& point) {
  centre_over_step(step.begin.A, step.middle.A, step.end.A, point.on_A);
  centre_over_step(step.begin.B, step.middle.B, step.end.B, point.on_B);
}

}  // namespace limber::joints
