// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"
#include "limber/joints/joint_motion.hpp"

/// States from the coordinates of joints.
namespace limber::dynamics {

/// By names of couplers; a joint that is not named is at zero.
using JointStates = std::map<std::string, joints::JointCoordinates>;

/// A state in which the joints have these coordinates and rates, see
/// place_bodies. In a group without a joint to the world, the first body that
/// is no joint's child is at the world's origin, at rest.
/// @throws InputError as place_bodies does.
[[nodiscard]] SystemState make_state(const SystemModel& model,
                                     const JointStates& joints);

/// Moves the bodies so that the joints have these coordinates and rates.
/// Clamped bodies, and of each other group of joined bodies the first that is
/// no joint's child (its frame M), keep their motion of `state`; so do modal
/// coordinates, which displace interfaces. Nodes of unreduced bodies follow,
/// undeformed. A joint between bodies that earlier joints have placed closes a
/// loop: it has no coordinates to give. Transmissions are ignored: geared
/// joints need coordinates each.
/// @throws InputError, listing all errors: an unknown joint, with the nearest
/// name; a wrong number of coordinates, a value that is not finite; a loop that
/// does not close, to 1e-6 of the size of the bodies linked to it, or 1e-6 rad,
/// or at 1e-6 of their speeds, with the gap.
void place_bodies(const SystemModel& model, const JointStates& joints,
                  SystemState& state);

/// Stores the full turns of joints beyond half a turn.
void store_turns(const SystemModel& model, const JointStates& joints,
                 SystemState& state);

}  // namespace limber::dynamics
