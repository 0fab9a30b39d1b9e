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

}  // namespace
}  // namespace limber::joints::discrete_gradient_test
