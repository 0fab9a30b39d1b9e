// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/integrators/step_motion.hpp"
#include "limber/joints/coordinates/discrete_gradient.hpp"

namespace limber::dynamics {

/// Forces of couplers, pairs, loads and gravity at the middle of a step, and
/// their mean powers: supplied less dissipated power is exactly the power that
/// they supply to bodies and couplers together.
///
/// Fills those parts of `terms` that NewtonMatrix and the residuals of a step
/// need: inertias J and H at the step's end; force_W, moment_B (by R^-1 of the
/// moment in the world, see step_motion.hpp) and modal_force; attachments;
/// couplers and transmissions. `response` and `applied` of the latter are sums
/// over both ends, twice the means, so that their derivatives with respect to
/// an increment of the step's end are those that NewtonMatrix expects. The
/// forces on bodies are those of `applied`.
/// @throws NumericalError naming the coupler and the time.
void calc_step_forces(const SystemModel& model, const SystemState& begin,
                      const SystemState& middle, const SystemTerms& begin_terms,
                      const SystemTerms& end_terms,
                      const joints::StepTimes& times, const StepMotion& motion,
                      SystemTerms& terms);

}  // namespace limber::dynamics
