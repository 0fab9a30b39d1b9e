// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "limber/dynamics/system/system_state.hpp"

namespace limber::dynamics {

/// Effect of an impulse of dampers.
struct DamperImpulse {
  std::string coupler;      ///< with the largest loss of damper power, or empty
  double kinetic = 0.0;     ///< energy before, of the motion damped [J]
  double dissipated = 0.0;  ///< [J]
  double work = 0.0;        ///< of drives [J]
  double relaxation = 0.0;  ///< approximate time in which dampers act [s]
};

/// Changes initial velocities by the impulse of those dampers that a step does
/// not resolve. A damper stops the relative motion of two bodies within m / c;
/// with a much longer step h it continues for about h / 2, and parallel springs
/// store energy without any source. Configuration and time do not change.
///
/// Equation   v+ = v - X^8 (v - v*), three times over,
///            X = (M + h C)^-1 h C,
///            C the damping of couplers and modes at the start, v* velocities
///            without damping forces (those commanded by drives). For a damper
///            with mu = c / m, X is h mu / (1 + h mu): where the step resolves
///            it, the relative velocity falls by 3 (h mu)^8 of itself, less
///            than the error of any scheme here; where it does not, to
///            (8 / (h mu))^3 of itself, which is the inelastic impact. M v
///            changes by impulses of dampers only, so that momenta are
///            conserved.
/// Source     (M + h C) v+ = M v is implicit Euler for the dampers; the power
///            of X is Limber's own. docs/decisions/0009
/// Limits     laws are linearised about the initial velocities; sliding
///            friction is excluded.
///
/// Does nothing unless a damper's power falls by more than a tenth, and the
/// energy of this decrease over the step exceeds 1e-6 of that of the relative
/// motion of the bodies it joins (find_relative_kinetic).
/// @param h the following step [s]
/// @throws NumericalError naming the coupler, as its forces do.
[[nodiscard]] std::optional<DamperImpulse> apply_damper_impulse(
    const SystemModel& model, double h, SystemState& state);

/// A message with the dissipated energy.
/// @param t time [s]
/// @param h the following step [s]
[[nodiscard]] std::string describe(const DamperImpulse& impulse, double t,
                                   double h);

}  // namespace limber::dynamics
