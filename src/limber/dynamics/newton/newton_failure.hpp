// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/newton/newton_measures.hpp"

namespace limber::dynamics {

/// State of Newton's method when it failed in a step.
struct NewtonFailure {
  const SystemModel& model;
  const SystemState& start;   ///< of the step
  const SystemTerms& terms;   ///< before the last correction
  const VectorX& increments;  ///< [m, rad, kg^1/2 m]
  const CorrectionSize& correction;
  double step = 0.0;   ///< [s]
  double end = 0.0;    ///< of the step [s]
  double limit = 0.0;  ///< largest error allowed [m]
};

/// The error message: the body and the time, `what`, and the likely cause with
/// its remedy. The cause is the first that applies: the fastest body rotates by
/// more than half a radian in the step; a mode moves more than any frame; the
/// coupler whose law differs most from the acting wrench.
[[nodiscard]] std::string describe(const NewtonFailure& failure,
                                   const char* what);

}  // namespace limber::dynamics
