// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"
#include "limber/joints/coordinates/axis_coordinate.hpp"

/// Rotations that coupler laws need from the frames that they join: the nodes
/// of an interface may not define all of them.
namespace limber::joints {

/// Rotations that a law needs from a frame, as a symmetric, positive
/// semi-definite matrix [-]. It needs no rotation about e if its product with e
/// is zero.
using RequiredRotations = Matrix3;

/// Rotations that a law needs from both frames: those that it constrains, damps
/// or drives in any pose that it permits. A direction counts however soft it is
/// compared with the others.
struct RequiredSides {
  RequiredRotations F = Matrix3::Zero();  ///< expressed in F [-]
  RequiredRotations M = Matrix3::Zero();  ///< expressed in M [-]

  RequiredSides& operator+=(const RequiredSides& other) {
    F += other.F;
    M += other.M;
    return *this;
  }
};

/// Rotation about one direction, of any length [-]; none if it is zero.
[[nodiscard]] RequiredRotations rotation_about(const Vector3& direction);

/// Rotations that a law along one of a joint's coordinates needs.
[[nodiscard]] RequiredSides find_required_rotations(
    const std::vector<AxisCoordinate>& coordinates, int index);

}  // namespace limber::joints
