// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/newton_measures.hpp"

namespace limber::dynamics {

/// Where Newton's method gave up in a step.
struct NewtonFailure {
  const SystemModel& model;
  const SystemState& start;  ///< of the step
  const SystemTerms& terms;  ///< before the last correction
  const VectorX& increments;
  const CorrectionSize& correction;
  double step = 0.0;       ///< [s]
  double end = 0.0;        ///< of the step [s]
  double tolerance = 0.0;  ///< of the step's motion [-]
};

/// Its text: the body and the time, `what`, and the likely cause with what
/// mends it. The cause is, the first that holds: the fastest body turns by more
/// than half a radian in the step; a mode moves more than any frame; the
/// coupler whose law is farthest from the wrench that acts.
[[nodiscard]] std::string describe(const NewtonFailure& failure,
                                   const char* what);

}  // namespace limber::dynamics
