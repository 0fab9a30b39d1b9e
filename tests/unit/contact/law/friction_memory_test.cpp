// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/friction_memory.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace limber::contact::friction_memory_test {
namespace {

Matrix3 turn(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

const Vector3 kNormal = Vector3(0.2, -0.5, 0.8).normalized();

FrictionMemory make_memory(const FrictionFrame& frame,
                           const BodyRotations& turns) {
  ShellMemory shells{.lowest = -3.0};
  for (std::size_t i = 0; i < kShells; ++i) {
    const double x = 1.0 + static_cast<double>(i);
    shells.shells[i] = {x, {0.3 * x, -0.4 * x, 0.1 * x}};
  }
  return keep_friction(shells, frame, turns);
}

Vector3 to_world(const FrictionFrame& frame, const ShellMemory& shells) {
  return frame.plane_W * shells.shells[2].spring.head<2>();
}

TEST(FrictionMemory, IsAsItWasWithoutMotion) {
  const FrictionFrame frame(kNormal);
  const BodyRotations turns{turn(0.3, {1, 2, 3}), turn(-0.7, {2, 0, 1})};
  const ShellMemory shells =
      recall_friction(make_memory(frame, turns), frame, turns);
  EXPECT_EQ(shells.lowest, -3.0);
  EXPECT_NEAR((shells.shells[4].spring - Vector3(1.5, -2.0, 0.5)).norm(), 0.0,
              1e-14);
  EXPECT_EQ(find_rotation_W({}, turns), Vector3(Vector3::Zero()));
}

// With both bodies and the normal it turns as a whole.
TEST(FrictionMemory, TurnsWithBothBodies) {
  const FrictionFrame frame(kNormal);
  const BodyRotations turns{turn(0.3, {1, 2, 3}), turn(-0.7, {2, 0, 1})};
  const FrictionMemory memory = make_memory(frame, turns);
  const Matrix3 R = turn(1.1, {-1, 1, 2});
  const BodyRotations later{R * turns.R_WA, R * turns.R_WB};
  const FrictionFrame turned(R * kNormal);
  const ShellMemory shells = recall_friction(memory, turned, later);
  const Vector3 before_W =
      to_world(frame, recall_friction(memory, frame, turns));
  EXPECT_NEAR((to_world(turned, shells) - R * before_W).norm(), 0.0, 1e-13);
  EXPECT_NEAR(find_rotation_W(memory, later).norm(), 0.0, 1e-14);
}

// About the normal by half of the turn of one body, with its length.
TEST(FrictionMemory, TurnsByTheMeanOfBothBodies) {
  const FrictionFrame frame(kNormal);
  const BodyRotations turns{turn(0.3, {1, 2, 3}), turn(-0.7, {2, 0, 1})};
  const FrictionMemory memory = make_memory(frame, turns);
  const Vector3 before_W =
      to_world(frame, recall_friction(memory, frame, turns));
  for (const double angle : {0.2, -0.5}) {
    const BodyRotations later{turns.R_WA, turn(angle, kNormal) * turns.R_WB};
    const Vector3 now_W =
        to_world(frame, recall_friction(memory, frame, later));
    EXPECT_NEAR((now_W - turn(0.5 * angle, kNormal) * before_W).norm(), 0.0,
                1e-13);
    EXPECT_NEAR((find_rotation_W(memory, later) - angle * kNormal).norm(), 0.0,
                1e-14);
  }
}

// Of the same two bodies by the other names, springs are opposite.
TEST(FrictionMemory, DoesNotDependOnNames) {
  const FrictionFrame frame(kNormal);
  const FrictionFrame other(-kNormal);
  const BodyRotations turns{turn(0.3, {1, 2, 3}), turn(-0.7, {2, 0, 1})};
  const BodyRotations later{turn(0.4, {1, 2, 3}), turn(-0.6, {2, 1, 1})};
  FrictionMemory memory = make_memory(frame, turns);
  const Vector3 now_W = to_world(frame, recall_friction(memory, frame, later));
  const Vector3 turned_W = find_rotation_W(memory, later);
  std::swap(memory.rotation_A, memory.rotation_B);
  for (auto& spring : memory.springs) spring.force_W *= -1.0;
  const BodyRotations swapped{later.R_WB, later.R_WA};
  const Vector3 swapped_W =
      to_world(other, recall_friction(memory, other, swapped));
  EXPECT_NEAR((now_W + swapped_W).norm(), 0.0, 1e-13);
  EXPECT_NEAR((find_rotation_W(memory, swapped) + turned_W).norm(), 0.0, 1e-14);
}

}  // namespace
}  // namespace limber::contact::friction_memory_test
