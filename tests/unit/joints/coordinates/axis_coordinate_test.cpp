// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/axis_coordinate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "limber/common/errors.hpp"
#include "limber/common/rotation.hpp"
#include "support/differences.hpp"
#include "unit/joints/coupler_cases.hpp"

namespace limber::joints::axis_coordinate_test {
namespace {

using testing::carried;
using testing::differentiate;
using testing::Margin;
using testing::moved;
using testing::random_motion;
using testing::random_vector;

const Vector3 kAxis = Vector3(2.0, -1.0, 2.0) / 3.0;
const Vector3 kNormal = Vector3(2.0, 2.0, -1.0) / 3.0;
const AxisCoordinate kAngle{AxisCoordinate::Kind::angle, kAxis};
const AxisCoordinate kDistance{AxisCoordinate::Kind::distance, kAxis};

RelativeMotion at_rotation(const Matrix3& R) {
  RelativeMotion motion;
  motion.R_FM = R;
  return motion;
}

TEST(AxisCoordinate, AnAngleIsCountedThroughAHundredTurnsAndBack) {
  constexpr double kStep = 0.37;
  const double end = 200.0 * std::numbers::pi;
  double near = 0.0;
  Margin margin;
  const auto go_to = [&](double angle) {
    const RelativeMotion motion = at_rotation(exp_rotation(angle * kAxis));
    const double z = evaluate(kAngle, motion, near).z;
    EXPECT_EQ(find_position(kAngle, motion, near), z);
    margin.add(std::abs(z - angle), 1.0);
    near = z;
  };
  for (double angle = 0.0; angle < end; angle += kStep) go_to(angle);
  EXPECT_GT(near, end - kStep);
  for (double angle = end; angle > -end; angle -= kStep) go_to(angle);
  EXPECT_LT(near, kStep - end);
  // Round-off of 628 rad in exp_rotation and in adding turns.
  margin.expect_below(1e-12);
}

TEST(AxisCoordinate, ATiltDoesNotMakeItJump) {
  const Matrix3 tilt = exp_rotation(0.8 * kNormal);
  double near = 0.0;
  for (double angle = 0.0; angle < 700.0; angle += 0.1) {
    const double z =
        evaluate(kAngle, at_rotation(tilt * exp_rotation(angle * kAxis)), near)
            .z;
    // Exactly: a swing about a normal axis leaves the twist as it is.
    EXPECT_NEAR(z, angle, 1e-11);
    near = z;
  }
}

TEST(AxisCoordinate, TheTwoAnglesOfAUniversalJointAreExact) {
  const AxisCoordinate second{AxisCoordinate::Kind::angle, kNormal};
  Margin margin;
  for (double s = -3.0; s <= 3.0; s += 0.25) {
    for (double t = -3.0; t <= 3.0; t += 0.25) {
      const RelativeMotion motion =
          at_rotation(exp_rotation(s * kAxis) * exp_rotation(t * kNormal));
      margin.add(std::abs(evaluate(kAngle, motion, 0.0).z - s), 1.0);
      margin.add(std::abs(evaluate(second, motion, 0.0).z - t), 1.0);
    }
  }
  // At 3 rad only cos(t / 2) = 0.07 of the quaternion determines the angle.
  margin.expect_below(1e-14 / 0.07);
}

TEST(AxisCoordinate, AnAxisUpsideDownHasNoAngle) {
  const Matrix3 half_turn = exp_rotation(std::numbers::pi * kNormal);
  for (const double angle : {0.0, 0.3, -2.0}) {
    const RelativeMotion motion =
        at_rotation(half_turn * exp_rotation(angle * kAxis));
    EXPECT_THROW(static_cast<void>(evaluate(kAngle, motion, 0.0)),
                 NumericalError);
    EXPECT_TRUE(std::isfinite(find_position(kAngle, motion, 0.0)));
  }
  const RelativeMotion nearly =
      at_rotation(exp_rotation((std::numbers::pi - 1e-3) * kNormal));
  EXPECT_NO_THROW(static_cast<void>(evaluate(kAngle, nearly, 0.0)));
}

TEST(AxisCoordinate, ADistanceIsTheShareAlongTheAxis) {
  RelativeMotion motion;
  motion.p_FM_F = Vector3(3.0, 0.0, 1.5);
  motion.v_FM_F = Vector3(0.0, 6.0, 0.0);
  const CoordinateValue value = evaluate(kDistance, motion, 99.0);
  EXPECT_NEAR(value.z, 3.0, 1e-15);
  EXPECT_NEAR(value.rate, -2.0, 1e-15);
  EXPECT_EQ(find_position(kDistance, motion, 99.0), value.z);
}

class AxisCoordinates : public ::testing::TestWithParam<AxisCoordinate> {
 protected:
  std::mt19937 random_{21};
};

TEST_P(AxisCoordinates, GradientIsTheDerivative) {
  Margin margin;
  for (int trial = 0; trial < 100; ++trial) {
    const RelativeMotion m = random_motion(JointKind::floating, random_);
    const CoordinateValue at = evaluate(GetParam(), m, 0.0);
    for (int i = 0; i < 6; ++i) {
      const double slope = differentiate([&](double by) {
        return evaluate(GetParam(), moved(m, i, by), at.z).z;
      });
      margin.add(std::abs(at.gradient[i] - slope), at.gradient.norm());
    }
  }
  margin.expect_below(1e-9);
}

TEST_P(AxisCoordinates, RateIsTheDerivativeByTime) {
  Margin margin;
  for (int trial = 0; trial < 100; ++trial) {
    const RelativeMotion m = random_motion(JointKind::floating, random_);
    const CoordinateValue at = evaluate(GetParam(), m, 40.0);
    const double rate = differentiate([&](double by) {
      return evaluate(GetParam(), carried(m, by), 40.0).z;
    });
    margin.add(std::abs(at.rate - rate), std::abs(at.rate));
  }
  margin.expect_below(1e-9);
}

TEST_P(AxisCoordinates, HessianIsTheDerivativeOfTheGradient) {
  Margin margin;
  for (int trial = 0; trial < 100; ++trial) {
    const RelativeMotion m = random_motion(JointKind::floating, random_);
    const CoordinateValue at = evaluate(GetParam(), m, 0.0);
    for (int i = 0; i < 6; ++i) {
      const Vector6 change = differentiate([&](double by) {
        return evaluate(GetParam(), moved(m, i, by), at.z).gradient;
      });
      Vector6 expected = Vector6::Zero();
      if (i >= 3) expected.tail<3>() = at.hessian.col(i - 3);
      margin.add((change - expected).norm(), 1.0 + at.hessian.norm());
    }
  }
  margin.expect_below(1e-9);
}

INSTANTIATE_TEST_SUITE_P(Each, AxisCoordinates,
                         ::testing::Values(kAngle, kDistance),
                         [](const auto& instance) {
                           return instance.index == 0 ? "Angle" : "Distance";
                         });

}  // namespace
}  // namespace limber::joints::axis_coordinate_test
