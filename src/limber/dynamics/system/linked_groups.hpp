// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/dynamics/system/system_state.hpp"

/// Which bodies of a system depend on each other.
namespace limber::dynamics {

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

/// sqrt(tr J / (2 m)), of the undeformed body [m].
[[nodiscard]] double radius_of_gyration(const BodyModel& body);

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

}  // namespace limber::dynamics
