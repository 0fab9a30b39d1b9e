// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/pose.hpp"

#include <gtest/gtest.h>

#include "limber/common/rotation.hpp"

namespace limber::pose_test {
namespace {

// A few operations on numbers of size one to ten.
constexpr double kRoundoff = 1e-14;

const Pose kX_AB{exp_rotation({0.3, -1.2, 2.0}), {1.0, -2.0, 0.5}};
const Pose kX_BC{exp_rotation({-2.5, 0.1, 0.7}), {-0.3, 4.0, 2.0}};
const Pose kX_CD{exp_rotation({0.0, 3.1, 0.0}), {7.0, 0.0, -1.0}};
const Vector3 kPoint{0.4, -0.9, 3.0};

void expect_equal(const Pose& a, const Pose& b) {
  EXPECT_LT((a.R - b.R).norm(), kRoundoff);
  EXPECT_LT((a.p - b.p).norm(), 10.0 * kRoundoff);
}

TEST(Pose, DefaultMovesNothing) {
  EXPECT_EQ((Pose{} * kPoint - kPoint).norm(), 0.0);
}

TEST(Pose, ProductMovesAPointThroughBothFrames) {
  EXPECT_LT(((kX_AB * kX_BC) * kPoint - kX_AB * (kX_BC * kPoint)).norm(),
            10.0 * kRoundoff);
}

TEST(Pose, ProductIsAssociative) {
  expect_equal((kX_AB * kX_BC) * kX_CD, kX_AB * (kX_BC * kX_CD));
}

TEST(Pose, InverseUndoesFromBothSides) {
  expect_equal(kX_AB * kX_AB.inverse(), Pose{});
  expect_equal(kX_AB.inverse() * kX_AB, Pose{});
}

TEST(Pose, InverseOfAProductIsTheProductOfInversesReversed) {
  expect_equal((kX_AB * kX_BC).inverse(), kX_BC.inverse() * kX_AB.inverse());
}

TEST(Rotation, TurnsAboutOneAxisAddUp) {
  const Vector3 axis = Vector3(1.0, -2.0, 0.5).normalized();
  const Matrix3 product = exp_rotation(0.8 * axis) * exp_rotation(1.7 * axis);
  EXPECT_LT((product - exp_rotation(2.5 * axis)).norm(), kRoundoff);
}

TEST(Rotation, TurnsAboutTwoAxesDoNotCommute) {
  const Matrix3 x = exp_rotation(0.5 * Vector3::UnitX());
  const Matrix3 y = exp_rotation(0.5 * Vector3::UnitY());
  // To lowest order the commutator is a turn by the cross product.
  const Vector3 commutator =
      log_rotation(Matrix3(x * y * x.transpose() * y.transpose()));
  EXPECT_GT(commutator.z(), 0.2);
  EXPECT_LT(commutator.z(), 0.3);
}

TEST(Rotation, ProductOfQuaternionsIsTheProductOfMatrices) {
  const Vector3 a(0.3, -1.2, 2.0);
  const Vector3 b(-2.5, 0.1, 0.7);
  const Quaternion product = exp_quaternion(a) * exp_quaternion(b);
  EXPECT_LT(
      (product.toRotationMatrix() - exp_rotation(a) * exp_rotation(b)).norm(),
      kRoundoff);
}

}  // namespace
}  // namespace limber::pose_test
