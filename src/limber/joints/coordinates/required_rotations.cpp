// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/required_rotations.hpp"

#include <algorithm>

namespace limber::joints {

RequiredRotations rotation_about(const Vector3& direction) {
  return direction * direction.transpose();
}

RequiredSides find_required_rotations(
    const std::vector<AxisCoordinate>& coordinates, int index) {
  using Kind = AxisCoordinate::Kind;
  const auto& own = coordinates.at(static_cast<std::size_t>(index));
  if (own.kind == Kind::distance) return {};
  const auto angles =
      std::count_if(coordinates.begin(), coordinates.end(),
                    [](const auto& c) { return c.kind == Kind::angle; });
  // With several angles, each rotates the axes of the others.
  if (angles > 1) return {Matrix3::Identity(), Matrix3::Identity()};
  return {rotation_about(own.axis), rotation_about(own.axis)};
}

}  // namespace limber::joints
