// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/dynamics/equations/workspace.hpp"

/// A system at rest: its configuration and unbalanced forces.
namespace limber::dynamics {

/// The same configuration without velocities.
[[nodiscard]] SystemState stop(const SystemState& state);

/// Moves a configuration by the fraction `share` [-] of increments as in
/// NewtonMatrix: translation in the world frame, rotation in the body frame,
/// modes, nodes.
void displace(const SystemModel& model, const VectorX& increments, double share,
              SystemState& state);

/// The increments that displace `from` to `to`, of the same model.
[[nodiscard]] VectorX find_increments(const SystemModel& model,
                                      const SystemState& from,
                                      const SystemState& to);

/// Weights of increments, such that the weighted norm is their length times the
/// root of the mass: of places [kg^1/2], of rotations [kg^1/2 m], of modes [-].
///
/// Equation   |w x|^2 = sum_b (m |dp|^2 + m r^2 |dtheta|^2 + |deta|^2
///            + m |du|^2 / N),   r the radius of gyration
[[nodiscard]] VectorX find_length_weights(const SystemModel& model);

/// Groups of connected bodies without a connection to the world.
[[nodiscard]] std::vector<std::vector<BodyIndex>> find_free_groups(
    const SystemModel& model);

/// Groups of bodies whose motions depend on each other: connected, also by
/// gears, except by way of the world or of a rigid body that it clamps, which
/// is a group of its own.
[[nodiscard]] std::vector<std::vector<BodyIndex>> find_linked_groups(
    const SystemModel& model);

/// Bodies that couplers and transmissions connect to each other, except by way
/// of the world; pairs connect none.
struct CoupledGroup {
  std::vector<BodyIndex> bodies;
  bool is_held = false;  ///< by the world
};
[[nodiscard]] std::vector<CoupledGroup> find_coupled_groups(
    const SystemModel& model);

/// Mass, place and size of a group of bodies.
struct GroupExtent {
  double mass = 0.0;                 ///< [kg]
  Vector3 centre = Vector3::Zero();  ///< of mass [m]
  double reach = 0.0;  ///< of bodies' origins from it, plus their radius of
                       ///< gyration; the largest [m]
};
[[nodiscard]] GroupExtent find_group_extent(
    const SystemModel& model, const SystemState& state,
    const std::vector<BodyIndex>& group);

/// Velocity of the mass centre of each body's free group; 0 of bodies that
/// something ties to the world [m/s].
[[nodiscard]] std::vector<Vector3> find_drifts(const SystemModel& model,
                                               const SystemState& state);

/// Checks that the forces on each free group balance, since internal forces
/// cannot balance them in any configuration.
/// @param terms at rest, evaluated by calc_terms
/// @throws InputError naming the bodies and the net force or moment.
void check_balance(const SystemModel& model, const SystemState& state,
                   const SystemTerms& terms);

}  // namespace limber::dynamics
