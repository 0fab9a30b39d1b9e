// SPDX-License-Identifier: BSD-3-Clause
#include "limber/common/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/draw_vector.hpp"

namespace limber::rotation_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRoundoff = 1e-14;
// Central differences with a step of 1e-5 leave about step^2 / 6 and
// roundoff / step.
constexpr double kStep = 1e-5;
constexpr double kDifference = 1e-9;

std::vector<Vector3> make_axes() {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Vector3> axes = {Vector3::UnitX(), Vector3::UnitY(),
                               -Vector3::UnitZ()};
  for (int i = 0; i < 20; ++i) {
    axes.push_back(
        testing::draw_vector([&] { return normal(random); }).normalized());
  }
  return axes;
}

// Angles [rad] on both sides of every change of formula.
const std::vector<double> kAngles = {
    0.0,  1e-300, 1e-12, 1e-9, 1e-6,       1e-4,       1e-3,
    1e-2, 0.1,    1.0,   2.5,  kPi - 1e-3, kPi - 1e-6, kPi - 1e-9};

TEST(Rotation, SkewIsTheCrossProduct) {
  const Vector3 a(1.0, -2.0, 3.0);
  const Vector3 b(0.5, 4.0, -1.0);
  EXPECT_EQ(skew(a) * b, a.cross(b));
  EXPECT_EQ(skew(a).transpose(), -skew(a));
}

TEST(Rotation, LogUndoesExpFromZeroToPi) {
  for (const Vector3& axis : make_axes()) {
    for (const double angle : kAngles) {
      const Vector3 theta = angle * axis;
      EXPECT_LE((log_rotation(exp_quaternion(theta)) - theta).norm(),
                4.0 * kRoundoff * std::max(angle, 1e-3))
          << angle << " about " << axis.transpose();
    }
  }
}

TEST(Rotation, LogOfAMatrixUndoesExpFromZeroToPi) {
  // A matrix holds a small angle to roundoff of one, not of the angle.
  for (const Vector3& axis : make_axes()) {
    for (const double angle : kAngles) {
      const Vector3 theta = angle * axis;
      EXPECT_LE((log_rotation(exp_rotation(theta)) - theta).norm(),
                10.0 * kRoundoff)
          << angle << " about " << axis.transpose();
    }
  }
}

TEST(Rotation, SmallAnglesKeepTheirRelativeAccuracy) {
  for (const double angle : {1e-12, 1e-9, 1e-6}) {
    const Vector3 theta = angle * Vector3(2.0, -1.0, 2.0) / 3.0;
    EXPECT_LE((log_rotation(exp_quaternion(theta)) - theta).norm(),
              kRoundoff * angle);
  }
}

TEST(Rotation, LogOfHalfATurnHasLengthPi) {
  for (const Vector3& axis : make_axes()) {
    const Vector3 theta = log_rotation(exp_rotation(kPi * axis));
    EXPECT_NEAR(theta.norm(), kPi, 10.0 * kRoundoff);
    // Both signs name the same rotation.
    EXPECT_NEAR(std::abs(theta.dot(axis)), kPi, 10.0 * kRoundoff);
  }
}

TEST(Rotation, LogTakesTheShortWay) {
  const Vector3 axis = Vector3(1.0, 2.0, -2.0) / 3.0;
  const Vector3 theta = log_rotation(exp_quaternion(1.5 * kPi * axis));
  EXPECT_LE((theta + 0.5 * kPi * axis).norm(), 10.0 * kRoundoff);
}

TEST(Rotation, LogIgnoresTheSignOfTheQuaternion) {
  const Quaternion q = exp_quaternion(Vector3(0.3, -0.8, 1.1));
  const Quaternion minus(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LE((log_rotation(q) - log_rotation(minus)).norm(), kRoundoff);
}

TEST(Rotation, QuaternionAndMatrixAgree) {
  for (const Vector3& axis : make_axes()) {
    for (const double angle : kAngles) {
      const Vector3 theta = angle * axis;
      const Matrix3 R = exp_rotation(theta);
      EXPECT_LE((exp_quaternion(theta).toRotationMatrix() - R).norm(),
                10.0 * kRoundoff);
      EXPECT_LE((R.transpose() * R - Matrix3::Identity()).norm(),
                10.0 * kRoundoff);
      EXPECT_NEAR(R.determinant(), 1.0, 10.0 * kRoundoff);
    }
  }
}

TEST(Rotation, ExpIsEigensAngleAxis) {
  for (const Vector3& axis : make_axes()) {
    const Matrix3 expected = Eigen::AngleAxisd(1.234, axis).toRotationMatrix();
    EXPECT_LE((exp_rotation(1.234 * axis) - expected).norm(), 10.0 * kRoundoff);
  }
}

TEST(Rotation, JacobiansAreDerivativesOfExp) {
  // exp(theta + d) = exp(J_l d) exp(theta) = exp(theta) exp(J_r d).
  for (const Vector3& axis : make_axes()) {
    for (const double angle : {0.0, 1e-6, 1e-3, 0.1, 1.0, 3.0}) {
      const Vector3 theta = angle * axis;
      const Quaternion q = exp_quaternion(theta);
      Matrix3 left;
      Matrix3 right;
      for (int i = 0; i < 3; ++i) {
        const Vector3 d = kStep * Vector3::Unit(i);
        const Quaternion plus = exp_quaternion(theta + d);
        const Quaternion minus = exp_quaternion(theta - d);
        left.col(i) = (log_rotation(plus * q.conjugate()) -
                       log_rotation(minus * q.conjugate())) /
                      (2.0 * kStep);
        right.col(i) = (log_rotation(q.conjugate() * plus) -
                        log_rotation(q.conjugate() * minus)) /
                       (2.0 * kStep);
      }
      EXPECT_LE((left_jacobian(theta) - left).norm(), kDifference) << angle;
      EXPECT_LE((right_jacobian(theta) - right).norm(), kDifference) << angle;
    }
  }
}

TEST(Rotation, JacobianDerivativeIsThatOfDifferences) {
  const Vector3 direction(0.3, -0.7, 0.5);
  for (const Vector3& axis : make_axes()) {
    for (const double angle : {0.0, 1e-6, 1e-3, 0.1, 0.3, 0.32, 1.0, 3.0}) {
      const Vector3 theta = angle * axis;
      const Matrix3 slope = (left_jacobian(theta + kStep * direction) -
                             left_jacobian(theta - kStep * direction)) /
                            (2.0 * kStep);
      EXPECT_LE((left_jacobian_derivative(theta, direction) - slope).norm(),
                kDifference)
          << angle;
    }
  }
}

TEST(Rotation, JacobiansDifferByTheRotation) {
  for (const Vector3& axis : make_axes()) {
    for (const double angle : kAngles) {
      const Vector3 theta = angle * axis;
      EXPECT_LE(
          (left_jacobian(theta) - exp_rotation(theta) * right_jacobian(theta))
              .norm(),
          10.0 * kRoundoff)
          << angle;
    }
  }
}

TEST(Rotation, InverseJacobianInvertsBelowAFullTurn) {
  for (const Vector3& axis : make_axes()) {
    for (const double angle : {0.0, 1e-9, 1e-4, 1e-2, 1.0, kPi, 4.0, 6.0}) {
      const Vector3 theta = angle * axis;
      const Matrix3 inverse = right_jacobian_inverse(theta);
      EXPECT_LE((inverse * right_jacobian(theta) - Matrix3::Identity()).norm(),
                10.0 * kRoundoff * inverse.norm())
          << angle;
    }
  }
}

}  // namespace
}  // namespace limber::rotation_test
