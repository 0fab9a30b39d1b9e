// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "limber/common/types.hpp"
#include "limber/dynamics/system/system_model.hpp"
#include "limber/results/history.hpp"

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
  [[nodiscard]] bool is_empty() const {
    return (lower.array() > upper.array()).any();
  }
  /// Its diagonal [m].
  [[nodiscard]] double size() const {
    return is_empty() ? 0.0 : (upper - lower).norm();
  }
};

/// Zero where the centre of the box is nearer to the origin than ten times its
/// size, or the box is empty; else the centre, rounded to the power of ten that
/// the size has, so that labels are short [m].
[[nodiscard]] Vector3 choose_offset(const Bounds& box);

/// A length of a rigid body: sqrt(tr J / m) [m].
[[nodiscard]] double estimate_radius(double mass, const Matrix3& J);

/// Where a body of some size is at T outputs.
struct Course {
  double radius = 0.0;  ///< [m]
  MatrixX p_WB;         ///< T x 3 [m]
};

/// Equation   p_WP(i) = offset + path(i) + what is drawn or stored
struct Home {
  Vector3 offset = Vector3::Zero();  ///< of choose_offset, for all outputs [m]
  /// T x 3: motion that all bodies have in common, the mean of their places
  /// less the offset; zero unless it goes 1000 times the size of the scene, of
  /// a run's states then without rows [m].
  MatrixX path;
  bool travels = false;  ///< whether the path is not zero
};
[[nodiscard]] Home find_home(const std::vector<Course>& courses);
[[nodiscard]] Home find_home(const dynamics::SystemModel& model,
                             const States& states);

/// The state with its bodies moved by -offset.
[[nodiscard]] dynamics::SystemState shift_bodies(dynamics::SystemState state,
                                                 const Vector3& offset);

}  // namespace limber::results
