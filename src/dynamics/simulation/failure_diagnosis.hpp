// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "dynamics/simulation.hpp"

/// What is said of a run that cannot go on.
namespace limber::dynamics {

/// The likely reason, in words, from the last good state: a body past its
/// critical speed, a step beyond the stability of an explicit scheme, a body
/// that turns far within a step. Empty if none is found.
/// @param h length of the step [s]
[[nodiscard]] std::string find_cause(const SystemModel& model,
                                     const SystemState& state,
                                     IntegratorKind integrator, double h);

/// Says which coupler's damper bodies start against, if in a step of h [s] it
/// would take ten times the energy that is stored; else empty. Bodies that
/// start with velocities that a stiff, damped coupler does not allow are
/// stopped by it within far less than a step, which no step can follow.
/// @param terms at the start @param stored energy [J]
[[nodiscard]] std::string find_start_clash(const SystemModel& model,
                                           const SystemTerms& terms,
                                           double stored, double h);

/// Where most of the stored energy is: a body's motion, a mode of it or a
/// coupler, as "mode 3 (812 Hz) of body 'link'".
[[nodiscard]] std::string find_most_energy(const SystemModel& model,
                                           const SystemState& state);

}  // namespace limber::dynamics
