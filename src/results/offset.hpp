// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "limber/common/types.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/dynamics/system/system_state.hpp"

/// Where files and pictures begin to count. Far from the origin of the world
/// single precision loses the motion, and so do labels of few digits; relative
/// to an offset near the bodies nothing is lost.
namespace limber::results {

struct Bounds {
  Vector3 lower = Vector3::Constant(1e300);
  Vector3 upper = Vector3::Constant(-1e300);

  void include(const Vector3& p) { include(p, 0.0); }
  /// A ball.
  void include(const Vector3& p, double radius) {
    lower = lower.cwiseMin((p.array() - radius).matrix());
    upper = upper.cwiseMax((p.array() + radius).matrix());
  }
  [[nodiscard]] double size() const { return (upper - lower).norm(); }
};

/// Zero where the centre of the box is nearer to the origin than ten times its
/// size, or the box is empty; else the centre, rounded to the power of ten that
/// the size has, so that labels are short [m].
[[nodiscard]] Vector3 choose_offset(const Bounds& box);

/// A length of a rigid body: sqrt(tr J / m) [m].
[[nodiscard]] double estimate_radius(double mass, const Matrix3& J);

/// Offset of all bodies at these states [m].
[[nodiscard]] Vector3 find_offset(
    const dynamics::SystemModel& model,
    std::span<const dynamics::SystemState> states);

/// The state with its bodies moved by -offset.
[[nodiscard]] dynamics::SystemState shift_bodies(dynamics::SystemState state,
                                                 const Vector3& offset);

}  // namespace limber::results
