// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "limber/joints/coordinates/motion.hpp"
#include "limber/joints/joint_kind.hpp"

namespace limber::joints {

/// Coordinates of one joint and their rates; empty: zero.
struct JointCoordinates {
  std::vector<double> position{};  ///< [m, rad]
  std::vector<double> velocity{};  ///< [m/s, rad/s]
};

/// Number of coordinates of a joint of this kind: 0, 1, 2, 3 or 6.
[[nodiscard]] std::size_t coordinate_count(JointKind kind);

/// Kind and axes of a joint.
struct JointShape {
  JointKind kind = JointKind::fixed;
  Vector3 axis_F = Vector3::UnitZ();    ///< unit [-]
  Vector3 second_F = Vector3::UnitX();  ///< unit, of a universal joint [-]
};

/// The kind of joint of a law, determined from its free coordinates.
/// @throws InputError if no kind leaves that free.
[[nodiscard]] JointShape find_shape(const Joint& joint);

/// Motion of frame M in F at a joint's coordinates, the constraint undeformed:
/// revolute, continuous: the angle; prismatic: the distance; planar: distances
/// along x and y of find_plane_axes, the angle; universal: the angles about
/// both axes, in this order; ball: roll, pitch, yaw; floating: x, y, z, roll,
/// pitch, yaw. Rates of ball and floating: velocity and angular velocity in F.
/// @param shape its axes are unit vectors
/// @throws ContractError for a number of positions or of velocities that is
/// neither zero nor the kind's.
[[nodiscard]] RelativeMotion find_joint_motion(
    const JointShape& shape, const JointCoordinates& coordinates);

}  // namespace limber::joints
