// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "dynamics/simulation.hpp"
#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// Longest step with which an explicit scheme is stable about `state` [s]. Of
/// Runge-Kutta and splitting a bound: no longer than the longest, about.
///
/// Equation   central differences: omega^2 h^2 + 4 c h = 4: 2 / omega without
///            damping, 1 / c without stiffness; Runge-Kutta: |lambda| h <= 2.6
///            with |lambda| <= (c + sqrt(c^2 + 4 omega^2)) / 2; splitting:
///            omega h <= 2 and c h <= 2, omega and c without the modes' own
///            springs and dampers. omega^2 and c are the largest eigenvalues
///            of the change of accelerations with positions and with
///            velocities, by power iteration on differences of the equations
///            of motion.
/// Source     central differences: the amplification matrix of
///            q'' = -omega^2 q - c q' has the eigenvalue -1 there; damping
///            counts twice as in [@belytschko2000, eq. 6.2.19], for it takes
///            v + h a, not v + h a / 2. Runge-Kutta: the half disc of radius
///            2.6 in the left half plane is in the region of stability of the
///            classic tableau (|R(z)| <= 1 up to 2.616 at 122 degrees), and
///            lambda^2 + c lambda + omega^2 = 0 with damping and stiffness of
///            whatever directions. Splitting: a kick by the midpoint rule is
///            1 - c h + c^2 h^2 / 2.
/// Limits     a thousandth long at most, by when the iteration ends; motion
///            that stiffens the system later is not foreseen. Infinite if
///            nothing vibrates.
/// @param scheme central_differences, runge_kutta_4 or splitting
[[nodiscard]] double find_stable_step(
    const SystemModel& model, const SystemState& state,
    IntegratorKind scheme = IntegratorKind::central_differences);

/// The body that moves most in the fastest vibration about `state`, the one
/// that bounds the step.
[[nodiscard]] std::size_t find_fastest_body(const SystemModel& model,
                                            const SystemState& state);

/// The share of it that simulate() takes.
inline constexpr double kStableShare = 0.95;

}  // namespace limber::dynamics
