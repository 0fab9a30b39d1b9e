// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "limber/common/types.hpp"

namespace limber::contact {

/// All points at one distance from a part of a line: a cylinder's side of an
/// endless one, with one or two round ends of others; a ball of a point.
struct RoundFit {
  static constexpr double kEndless = std::numeric_limits<double>::infinity();

  Vector3 centre = Vector3::Zero();  ///< on the line [m]
  Vector3 axis = Vector3::UnitZ();   ///< unit [-]
  double low = -kEndless;            ///< the part, from the centre [m]
  double high = kEndless;
  double radius = 0.0;
  double error = 0.0;  ///< largest distance of a point from the surface [m]

  [[nodiscard]] double find_height(const Vector3& x) const {
    return axis.dot(x - centre);
  }
  [[nodiscard]] double find_distance(const Vector3& x) const;
};

/// The sphere that minimises the squares of |x - c|^2 - r^2. @returns nothing
/// for points in a plane
[[nodiscard]] std::optional<RoundFit> fit_ball(std::span<const Vector3> points);

/// The line with a radius of least squares of the distances, by Newton's method
/// without second derivatives.
/// @param axis unit, near that of the line
/// @param has_low, has_high whether there is a round end behind, ahead
/// @returns nothing where it does not converge
[[nodiscard]] std::optional<RoundFit> fit_rod(std::span<const Vector3> points,
                                              const Vector3& axis, bool has_low,
                                              bool has_high);

}  // namespace limber::contact
