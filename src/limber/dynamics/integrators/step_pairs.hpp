// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/integrators/step_motion.hpp"
#include "limber/joints/coordinates/discrete_gradient.hpp"

namespace limber::dynamics {

/// Forces of pairs over a step, as calc_step_forces adds those of couplers: at
/// the means of the points' positions at both ends, where their work is that
/// force times the change of p_B - p_A, exactly. Moments are added in world
/// axes, about Bo.
/// @param begin_terms, end_terms evaluated in this step: the coordinates that
/// their bodies refer to are read
/// @throws NumericalError naming the pair and the time.
void apply_pairs_over_step(const SystemModel& model, const SystemState& begin,
                           const SystemState& middle,
                           const SystemTerms& begin_terms,
                           const SystemTerms& end_terms,
                           const joints::StepTimes& times,
                           const StepMotion& motion, SystemTerms& terms);

}  // namespace limber::dynamics
