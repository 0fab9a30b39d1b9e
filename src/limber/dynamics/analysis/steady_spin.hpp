// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// The steady rotation near a state: deformed so that nothing changes in axes
/// that rotate with the system, at the angular velocity of the start.
///
/// Equation   r(x) = M a + bias - forces = 0 at velocities v_0 + w x (p - p_0)
///            and accelerations w x (v - v_f), v_f that of the mass centre of a
///            system that nothing ties to the world, else 0; by Newton's method
///            with the stiffness S of SmallMotion in these axes. A small share
///            of M, which does not change the solution, is added to S, for
///            motion that S leaves free. Rotations about the axis that nothing
///            holds keep their angles: dampers that do not rotate may brake
///            them, which no angle would balance; the rest is found for bodies
///            so braked
/// Limits     dense: (6 bodies + modes)^3. No pairs, no bodies at level `full`
/// @param start its velocities are those of a rotation of all bodies about one
/// axis, of constant direction in the world
/// @throws InputError for other velocities, and for gravity or loads fixed in
/// the world and normal to the axis, which exclude steady rotation;
/// NumericalError if there is no such motion near the start
[[nodiscard]] SystemState find_steady_spin(const SystemModel& model,
                                           const SystemState& start);

}  // namespace limber::dynamics
