// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/terms/system_terms.hpp"

/// A system at rest: its configuration and unbalanced forces.
namespace limber::dynamics {

/// The same configuration without velocities.
[[nodiscard]] SystemState stop(const SystemState& state);

/// Weights of increments, such that the weighted norm is their length times the
/// root of the mass: of places [kg^1/2], of rotations [kg^1/2 m], of modes [-].
///
/// Equation   |w x|^2 = sum_b (m |dp|^2 + m r^2 |dtheta|^2 + |deta|^2
///            + m |du|^2 / N),   r the radius of gyration
[[nodiscard]] VectorX find_length_weights(const SystemModel& model);

/// Checks that the forces on each free group balance, since internal forces
/// cannot balance them in any configuration.
/// @param terms at rest, evaluated by calc_terms
/// @throws InputError naming the bodies and the net force or moment.
void check_balance(const SystemModel& model, const SystemState& state,
                   const SystemTerms& terms);

}  // namespace limber::dynamics
