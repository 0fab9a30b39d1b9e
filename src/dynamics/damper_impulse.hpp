// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "dynamics/system_state.hpp"

namespace limber::dynamics {

/// What an impulse of dampers did.
struct DamperImpulse {
  std::string coupler;      ///< whose damper's power fell most; else empty
  double kinetic = 0.0;     ///< energy before [J]
  double dissipated = 0.0;  ///< [J]
  double work = 0.0;        ///< of drives [J]
  double relaxation = 0.0;  ///< time in which the dampers act, about [s]
};

/// Brings velocities onto what dampers allow that a step is too long to
/// resolve. A damper stops two bodies within m / c; a scheme whose step h is
/// far longer lets them go on for about half of it, and the springs beside the
/// damper then store what nobody supplied. Configuration and time stay.
///
/// Equation   v+ = v - X^8 (v - v*), three times over,
///            X = (M + h C)^-1 h C,
///            C the damping of couplers and modes at the start, v* velocities
///            at which dampers do nothing (those that drives ask for). Of a
///            damper with mu = c / m, X is h mu / (1 + h mu): of relative
///            velocity 3 (h mu)^8 is taken where the step resolves it, less
///            than the error of any scheme here; all but (8 / (h mu))^3 where
///            it does not, which is the inelastic impact. M v changes by the
///            dampers' impulses alone, so that momenta are kept.
/// Source     (M + h C) v+ = M v is implicit Euler of the dampers; its power is
///            our own. docs/decisions/0009
/// Limits     laws are taken as linear about the start's velocities; friction
///            that slides is left alone.
///
/// Does nothing unless a damper's power falls by more than a tenth, and that
/// share of it, over the step, is more than 1e-6 of the kinetic energy.
/// @param h the step that is to follow [s]
/// @throws NumericalError naming the coupler, as forces do.
[[nodiscard]] std::optional<DamperImpulse> apply_damper_impulse(
    const SystemModel& model, double h, SystemState& state);

/// In words, with the energy.
[[nodiscard]] std::string describe(const DamperImpulse& impulse, double t,
                                   double h);

}  // namespace limber::dynamics
