// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flexbody/reduced_body.hpp"
#include "joints/coupler_law.hpp"
#include "scene/mounts.hpp"

/// Nodes on one line define no rotation about it, a single node none at all.
/// What asks a rotation that an interface does not have is refused, at every
/// level of fidelity.
namespace limber::scene {

/// Rotations that are asked of an interface: symmetric, positive
/// semi-definite; e is a direction that is not asked if asked e = 0. Without
/// unit.
using AskedRotations = Matrix3;

/// Those of a law, of the interface under F and of that under M, axes of F and
/// of M: what it holds, damps or drives in any pose that it leaves free.
/// However soft one direction is beside the others, it counts.
struct AskedSides {
  AskedRotations F = Matrix3::Zero();
  AskedRotations M = Matrix3::Zero();
};
[[nodiscard]] AskedSides find_asked_rotations(const joints::CouplerLaw& law);

/// Those of a law along one of a joint's coordinates.
[[nodiscard]] AskedSides find_asked_rotations(
    const std::vector<joints::AxisCoordinate>& coordinates, int index);

/// The rotation about one direction of any length; none if it is zero.
[[nodiscard]] AskedRotations rotation_about(const Vector3& direction);

/// @param asked_B axes of the body frame
/// @throws InputError if a rotation is asked that the nodes do not define: what
/// the nodes are, which direction, what mends it.
void check_rotation(const flexbody::InterfaceTable& table,
                    const AskedRotations& asked_B);

/// The same of a mount that has nodes; the error names its link.
/// @param asked_F axes of the mount's frame
void check_rotation(const Mount& mount, const AskedRotations& asked_F);

}  // namespace limber::scene
