// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/dynamics/terms/system_terms.hpp"

/// Diagnosis of simulations that fail.
namespace limber::dynamics {

/// A message with the likely cause, from a state before the motion blew up: a
/// body above its critical speed, a joint that the loads overpower, a step
/// beyond the stability limit of an explicit scheme, a body that rotates too
/// far within a step. Empty if none is found.
/// @param h length of the step [s]
[[nodiscard]] std::string find_cause(const SystemModel& model,
                                     const SystemState& state,
                                     IntegratorKind integrator, double h);

/// A message naming the coupler whose damper opposes the initial velocities, if
/// it would dissipate ten times the energy of the relative motion of the bodies
/// that it joins within a step; else empty. A
/// stiff, damped coupler stops incompatible initial velocities within much less
/// than a step, which the step does not resolve.
/// @param terms at the start
/// @param h length of the step [s]
[[nodiscard]] std::string find_start_clash(const SystemModel& model,
                                           const SystemState& state,
                                           const SystemTerms& terms, double h);

/// What supplies most power at a state, as in "; the largest power is that of
/// the drive of joint 'elbow' (controller 'servo', period 0.002 s): 36 W": a
/// drive, or the loads on a body; and the contact with the largest force. Empty
/// if nothing does.
[[nodiscard]] std::string find_driver(const SystemModel& model,
                                      const SystemState& state);

/// Location of the largest part of the stored energy: the motion or a mode of a
/// body, relative to the mass centre of its free group, or a coupler, as
/// in "mode 3 (812 Hz) of body 'link'".
[[nodiscard]] std::string find_most_energy(const SystemModel& model,
                                           const SystemState& state);

}  // namespace limber::dynamics
