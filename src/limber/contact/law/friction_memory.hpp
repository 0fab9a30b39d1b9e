// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "limber/common/types.hpp"
#include "limber/contact/law/load_shells.hpp"
#include "limber/contact/law/rolling_resistance.hpp"

namespace limber::contact {

/// Rotations of both bodies.
struct BodyRotations {
  Matrix3 R_WA = Matrix3::Identity();
  Matrix3 R_WB = Matrix3::Identity();
};

/// Directions of friction on B: two in the tangent plane, and about the normal.
struct FrictionFrame {
  explicit FrictionFrame(const Vector3& normal_W);

  Vector3 normal_W;                     ///< from A to B, unit [-]
  Eigen::Matrix<double, 3, 2> plane_W;  ///< unit [-]
};

/// Friction's springs between steps, and the rotations at which they were
/// kept: a plain value of kFrictionNumbers.
struct FrictionMemory {
  struct Spring {
    double stiffness = 0.0;             ///< [N/m]
    Vector3 force_W = Vector3::Zero();  ///< in the tangent plane [N]
    double spin = 0.0;                  ///< about the normal, over r_e [N]
  };
  double lowest = 0.0;  ///< see ShellMemory
  std::array<Spring, kShells> springs = {};
  double rolling_stiffness = 0.0;       ///< [N m]
  Vector3 rolling_W = Vector3::Zero();  ///< in the tangent plane [N m]
  Eigen::Vector4d rotation_A = Eigen::Vector4d::Zero();  ///< quaternion x y z w
  Eigen::Vector4d rotation_B =
      Eigen::Vector4d::Zero();  ///< all 0 before the first
};

inline constexpr std::size_t kFrictionNumbers = 13 + 5 * kShells;

[[nodiscard]] FrictionMemory keep_friction(const ShellMemory& shells,
                                           const FrictionFrame& frame,
                                           const BodyRotations& rotations,
                                           const RollingSpring& rolling = {});

/// The springs at present rotations: rotated by the mean of both bodies'
/// rotations since then, whatever the bodies' order, into the present tangent
/// plane, where they keep their length.
[[nodiscard]] ShellMemory recall_friction(const FrictionMemory& memory,
                                          const FrictionFrame& frame,
                                          const BodyRotations& rotations);

/// Likewise.
[[nodiscard]] RollingSpring recall_rolling(const FrictionMemory& memory,
                                           const FrictionFrame& frame,
                                           const BodyRotations& rotations);

/// Rotation of B relative to A since then, less than half a turn [rad].
[[nodiscard]] Vector3 find_rotation_W(const FrictionMemory& memory,
                                      const BodyRotations& rotations);

/// Calls `visit` with every number, in one order.
template <typename Memory, typename Visit>
void visit_friction(Memory& memory, const Visit& visit) {
  visit(memory.lowest);
  for (auto& spring : memory.springs) {
    visit(spring.stiffness);
    for (int i = 0; i < 3; ++i) visit(spring.force_W[i]);
    visit(spring.spin);
  }
  visit(memory.rolling_stiffness);
  for (int i = 0; i < 3; ++i) visit(memory.rolling_W[i]);
  for (int i = 0; i < 4; ++i) visit(memory.rotation_A[i]);
  for (int i = 0; i < 4; ++i) visit(memory.rotation_B[i]);
}

}  // namespace limber::contact
