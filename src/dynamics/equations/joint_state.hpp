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
/// place_bodies. Where no joint leads to the world, the first body of a group
/// that is no joint's child stands at the world's origin, at rest.
/// @throws InputError as place_bodies does.
[[nodiscard]] SystemState make_state(const SystemModel& model,
                                     const JointStates& joints);

/// Moves the bodies so that the joints have these coordinates and rates. The
/// world, clamped bodies, and of each other group of joined bodies the first
/// that is no joint's child (its frame M) stay as they are in `state`; so do
/// modal coordinates, with which interfaces stand where they are. Nodes of
/// unreduced bodies follow, undeformed. A joint added later than those that
/// have placed its bodies closes a loop: it has no coordinates to give.
/// Transmissions are not looked at: what is geared is given for each joint.
/// @throws InputError, with all that is wrong: an unknown joint, with the
/// nearest name; a number of coordinates that is not the joint's, a value that
/// is not finite; a loop that does not close, to 1e-6 of the system's size,
/// 1e-6 rad, or as much per second, with the gap.
void place_bodies(const SystemModel& model, const JointStates& joints,
                  SystemState& state);

/// Stores the full turns of joints beyond half a turn.
void store_turns(const SystemModel& model, const JointStates& joints,
                 SystemState& state);

}  // namespace limber::dynamics
