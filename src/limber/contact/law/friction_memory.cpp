// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/friction_memory.hpp"

#include <cmath>

namespace limber::contact {
namespace {

Matrix3 to_matrix(const Eigen::Vector4d& rotation) {
  return Quaternion(rotation).toRotationMatrix();
}

bool is_new(const FrictionMemory& memory) {
  return memory.rotation_B.isZero(0.0);
}

// The mean of both bodies' rotations since then.
Matrix3 find_mean_rotation(const FrictionMemory& memory,
                           const BodyRotations& rotations) {
  return 0.5 * (rotations.R_WA * to_matrix(memory.rotation_A).transpose() +
                rotations.R_WB * to_matrix(memory.rotation_B).transpose());
}

Eigen::Vector2d carry(const Vector3& vector_W, const Matrix3& rotation,
                      const FrictionFrame& frame) {
  const Eigen::Vector2d inside =
      frame.plane_W.transpose() * (rotation * vector_W);
  const double length = inside.norm();
  return length > 0.0 ? Eigen::Vector2d(vector_W.norm() / length * inside)
                      : inside;
}

}  // namespace

FrictionFrame::FrictionFrame(const Vector3& normal) : normal_W(normal) {
  plane_W.col(0) = normal.unitOrthogonal();
  plane_W.col(1) = normal.cross(Vector3(plane_W.col(0)));
}

FrictionMemory keep_friction(const ShellMemory& shells,
                             const FrictionFrame& frame,
                             const BodyRotations& rotations,
                             const RollingSpring& rolling) {
  FrictionMemory memory;
  memory.lowest = shells.lowest;
  for (std::size_t i = 0; i < kShells; ++i) {
    const LoadShell& shell = shells.shells[i];
    memory.springs[i] = {shell.stiffness,
                         frame.plane_W * shell.spring.head<2>(),
                         shell.spring[2]};
  }
  memory.rolling_stiffness = rolling.stiffness;
  memory.rolling_W = frame.plane_W * rolling.moment;
  memory.rotation_A = Quaternion(rotations.R_WA).coeffs();
  memory.rotation_B = Quaternion(rotations.R_WB).coeffs();
  return memory;
}

ShellMemory recall_friction(const FrictionMemory& memory,
                            const FrictionFrame& frame,
                            const BodyRotations& rotations) {
  ShellMemory shells{.lowest = memory.lowest};
  if (is_new(memory)) return shells;
  const Matrix3 rotation = find_mean_rotation(memory, rotations);
  for (std::size_t i = 0; i < kShells; ++i) {
    const FrictionMemory::Spring& spring = memory.springs[i];
    shells.shells[i].stiffness = spring.stiffness;
    shells.shells[i].spring << carry(spring.force_W, rotation, frame),
        spring.spin;
  }
  return shells;
}

RollingSpring recall_rolling(const FrictionMemory& memory,
                             const FrictionFrame& frame,
                             const BodyRotations& rotations) {
  if (is_new(memory)) return {};
  return {
      memory.rolling_stiffness,
      carry(memory.rolling_W, find_mean_rotation(memory, rotations), frame)};
}

Vector3 find_rotation_W(const FrictionMemory& memory,
                        const BodyRotations& rotations) {
  if (is_new(memory)) return Vector3::Zero();
  const Matrix3 before =
      to_matrix(memory.rotation_A).transpose() * to_matrix(memory.rotation_B);
  const Quaternion rotation(Matrix3(rotations.R_WA.transpose() *
                                    rotations.R_WB * before.transpose()));
  const double sine = rotation.vec().norm();
  if (sine == 0.0) return Vector3::Zero();
  const double angle = 2.0 * std::atan2(sine, std::abs(rotation.w()));
  const double fraction = std::copysign(angle / sine, rotation.w());
  return fraction * (rotations.R_WA * rotation.vec());
}

}  // namespace limber::contact
