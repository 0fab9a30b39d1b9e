// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "limber/flexbody/model/reduced_body.hpp"
#include "limber/joints/coordinates/required_rotations.hpp"

/// Nodes on one line define no rotation about it, a single node none at all.
/// Uses of a rotation that an interface does not define are rejected, at every
/// level of fidelity.
namespace limber::dynamics {

/// @param required_B expressed in the body frame
/// @throws InputError if a required rotation is not defined by the nodes: with
/// the nodes, the direction and the remedy.
void check_rotation(const flexbody::InterfaceTable& table,
                    const joints::RequiredRotations& required_B);

}  // namespace limber::dynamics
