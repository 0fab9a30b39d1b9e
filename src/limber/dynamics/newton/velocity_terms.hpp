// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/terms/system_terms.hpp"

/// Accelerations across links that velocities alone cause, and what they
/// require of the links' wrenches.
namespace limber::dynamics {

/// Relative accelerations of links whose bodies do not accelerate, centripetal
/// ones for example, six a coupler, of M in F [m/s^2, rad/s^2], then one per
/// transmission, in the first entry.
///
/// Equation   gamma = dG/dt v of G v, the links' relative velocities: their
///            central difference over a motion by the velocities v that turns
///            no frame by more than 1e-4 rad
[[nodiscard]] std::vector<Vector6> find_velocity_terms(
    const SystemModel& model, const SystemState& state);

/// Adds them to the gaps of NewtonMatrix (NewtonMatrix::find_gap), so that its
/// increments x are those of accelerations c x.
///
/// Equation   G c x + gamma = 0 where K or a constraint holds: s = -K gamma / c
/// @param acceleration, velocity c and v of TangentCoefficients
void add_velocity_terms(const SystemTerms& terms,
                        const std::vector<Vector6>& velocity_terms,
                        double acceleration, double velocity,
                        std::vector<Vector6>& gaps);

}  // namespace limber::dynamics
