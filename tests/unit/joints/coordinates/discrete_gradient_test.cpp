// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/coordinates/discrete_gradient.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace limber::joints::discrete_gradient_test {
namespace {

RelativeMotion turned(const Vector3& axis, double angle) {
  RelativeMotion motion;
  motion.R_FM = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  return motion;
}

// A quaternion and its negative are one rotation: near half a turn about a
// diagonal, those of a step's ends come with opposite signs.
TEST(CoordinateStep, HasTheGradientHalfwayWhereTheTurnPassesHalfATurn) {
  const AxisCoordinate diagonal{AxisCoordinate::Kind::angle,
                                Vector3(1.0, -1.0, 0.0).normalized()};
  for (const double turn : {-1.0, 1.0}) {
    const RelativeMotion begin =
        turned({1.02, -1.0, 0.01}, std::numbers::pi - 0.03 * turn);
    const RelativeMotion end =
        turned({1.0, -1.02, 0.01}, std::numbers::pi + 0.01 * turn);
    const Eigen::AngleAxisd way(Matrix3(end.R_FM * begin.R_FM.transpose()));
    RelativeMotion middle = begin;
    middle.R_FM = Eigen::AngleAxisd(0.5 * way.angle(), way.axis()) * begin.R_FM;
    const CoordinateStep step = find_coordinate_step(
        diagonal, {begin, end, RelativeMotion{}}, 3.0, 1.0);
    const CoordinateValue expected = evaluate(diagonal, middle, 3.0);
    EXPECT_LT((step.gradient - expected.gradient).norm(), 1e-12);
    EXPECT_LT((step.hessian - expected.hessian).norm(), 1e-12);
  }
}

// 1e6 m from the origin both ends of a step round by 1e-10 m.
TEST(CoordinateStep, EndsWhereItsRateLeads) {
  constexpr double kRounded = 1e-10;
  const AxisCoordinate along{AxisCoordinate::Kind::distance, Vector3::UnitX()};
  RelativeMotion begin;
  begin.p_FM_F.x() = 0.5;
  RelativeMotion end = begin;
  end.p_FM_F.x() += 1e-9 + kRounded;
  RelativeMotion mean = begin;
  mean.v_FM_F.x() = 1e-6;
  const CoordinateStep step =
      find_coordinate_step(along, {begin, end, mean}, 0.0, 1e-3);
  EXPECT_NEAR(step.z1 - step.z0, 1e-9, 1e-15);
}

// Of a spring of 1 N/m from 1 m to 1.001 m.
StepBalance make_balance(double rounding) {
  const double z1 = 1.001 + rounding;
  return {.energy0 = 0.5,
          .energy1 = 0.5 * z1 * z1,
          .h = 1.0,
          .power = -1.0005 * 0.001,
          .force = -1.0005,
          .z0 = 1.0,
          .z1 = z1};
}

TEST(StepBalance, LacksNothingThatRoundOffOfTheCoordinateExplains) {
  EXPECT_EQ(find_lack(make_balance(0.0)), 0.0);
  EXPECT_EQ(find_lack(make_balance(4e-16)), 0.0);
  EXPECT_NEAR(find_lack(make_balance(1e-12)), -1.001e-12, 2e-15);
  // A force of which the energies are small: of a stop, at its edge.
  const StepBalance edge{
      .h = 1.0, .power = -1e-16, .force = -1.0, .z0 = 1.0, .z1 = 1.0 + 1e-16};
  EXPECT_EQ(find_lack(edge), 0.0);
}

}  // namespace
}  // namespace limber::joints::discrete_gradient_test
