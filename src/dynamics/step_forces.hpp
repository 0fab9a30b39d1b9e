// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/law_over_step.hpp"
#include "dynamics/step_motion.hpp"

namespace limber::dynamics {

/// Forces of couplers, loads and gravity over a step, at its middle, and their
/// mean powers: load_power - dissipated_power is what all of them give to
/// bodies and couplers together, exactly.
///
/// Fills of `terms` what NewtonMatrix needs and residuals of a step: inertias J
/// and H at the step's end; force_W, moment_B (of R^-1 and the moment in the
/// world, see StepMotion) and modal_force; attachments; couplers and
/// transmissions. Of these, response and applied are the sums over both ends,
/// twice the means: with them an increment of the step's end has the
/// derivatives that NewtonMatrix expects. `applied` acts.
/// @throws NumericalError naming the coupler and the time.
void calc_step_forces(const SystemModel& model, const SystemState& begin,
                      const SystemState& middle, const SystemTerms& begin_terms,
                      const SystemTerms& end_terms, const StepTimes& times,
                      const StepMotion& motion, SystemTerms& terms);

}  // namespace limber::dynamics
