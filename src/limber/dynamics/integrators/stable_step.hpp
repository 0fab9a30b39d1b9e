// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/integrators/integrator_kind.hpp"
#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Longest step with which an explicit scheme is stable about `state` [s]; for
/// Runge-Kutta and splitting a lower bound, approximately.
///
/// Equation   central differences: omega^2 h^2 + 4 c h = 4: 2 / omega without
///            damping, 1 / c without stiffness; Runge-Kutta: |lambda| h <= 2.6
///            with |lambda| <= (c + sqrt(c^2 + 4 omega^2)) / 2; splitting:
///            omega h <= 2 and c h <= 2, omega and c without the modes' own
///            springs and dampers. omega^2 and c are the largest eigenvalues
///            of minus the derivatives of accelerations with respect to
///            positions and velocities, by power iteration on finite
///            differences of the equations of motion.
/// Source     central differences: the amplification matrix of
///            q'' = -omega^2 q - c q' has the eigenvalue -1 there; damping
///            counts twice that of [@belytschko2000, eq. 6.2.19], since forces
///            use v + h a, not v + h a / 2. Runge-Kutta: the half disc of
///            radius 2.6 in the left half plane is in the region of stability
///            of the classic tableau (|R(z)| <= 1 up to 2.616 at 122 degrees),
///            and lambda^2 + c lambda + omega^2 = 0 with damping and stiffness
///            in any directions. Splitting: a kick by the midpoint rule
///            multiplies by 1 - c h + c^2 h^2 / 2.
/// Limits     up to a thousandth too long, by the end of the iteration; later
///            stiffening of the system is not considered. Infinite if nothing
///            vibrates.
/// @param scheme central_differences, runge_kutta_4 or splitting
[[nodiscard]] double find_stable_step(
    const SystemModel& model, const SystemState& state,
    IntegratorKind scheme = IntegratorKind::central_differences);

/// Index of the body with the largest motion in the fastest vibration about
/// `state`, which limits the step.
[[nodiscard]] std::size_t find_fastest_body(const SystemModel& model,
                                            const SystemState& state);

/// Fraction of the stable step that simulate() uses [-].
inline constexpr double kStableFraction = 0.95;

}  // namespace limber::dynamics
