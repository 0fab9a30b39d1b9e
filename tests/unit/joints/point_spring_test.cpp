// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/point_spring.hpp"

#include <gtest/gtest.h>

#include "limber/common/errors.hpp"

namespace limber::joints::point_spring_test {
namespace {

RelativeMotion at(double x, double rate = 0.0) {
  RelativeMotion motion;
  motion.p_FM_F.x() = x;
  motion.v_FM_F.x() = rate;
  return motion;
}

TEST(PointSpring, EndsThatCoincideHaveNoDirection) {
  const std::vector<double> x{0.0, 1.0};
  for (const PointSpring& spring :
       {PointSpring({.stiffness = 1.0, .free_length = 1.0}),
        PointSpring({.extensions = x, .forces = x}),
        PointSpring(
            {.stiffness = 1.0, .free_length = 1.0, .quadratic = 2.0})}) {
    EXPECT_THROW(static_cast<void>(spring.evaluate(at(0.0))), NumericalError);
  }
}

TEST(PointSpring, WithoutLengthItIsSmoothWhereItsEndsCoincide) {
  const PointSpring spring(
      {.stiffness = 5.0, .damping = 2.0, .quadratic = 3.0});
  const CouplerResponse here = spring.evaluate(at(0.0, 1.5));
  EXPECT_EQ(here.wrench[0], -3.0);
  EXPECT_EQ(here.dissipation, 4.5);
  EXPECT_EQ((Matrix3(here.stiffness.topLeftCorner<3, 3>())),
            (Matrix3(5.0 * Matrix3::Identity())));
  EXPECT_NEAR(spring.evaluate(at(2.0)).wrench[0], -22.0, 1e-14);
  EXPECT_NEAR(spring.evaluate(at(2.0)).energy, 18.0, 1e-14);
}

// Ends that part pull at each other, whatever the direction.
TEST(PointSpring, ReadsLengthAndTensionAlsoWhereItsEndsCoincide) {
  const PointSpring spring({.stiffness = 5.0, .damping = 2.0});
  const CoordinateReading here = spring.read(0, at(0.0, -1.5), {}, {});
  EXPECT_EQ(here.motion.z, 0.0);
  EXPECT_EQ(here.motion.rate, 1.5);
  EXPECT_EQ(here.effort, 3.0);
  const CoordinateReading apart = spring.read(0, at(-0.5, -1.5), {}, {});
  EXPECT_EQ(apart.motion.z, 0.5);
  EXPECT_EQ(apart.motion.rate, 1.5);
  EXPECT_EQ(apart.effort, 5.5);
}

TEST(PointSpring, ASlackLineMayHaveItsEndsTogether) {
  const PointSpring line(
      {.stiffness = 5.0, .free_length = 1.0, .tension_only = true});
  EXPECT_EQ(line.evaluate(at(0.0, 3.0)).wrench.norm(), 0.0);
  EXPECT_EQ(line.evaluate(at(0.0)).stiffness.norm(), 0.0);
  EXPECT_EQ(line.evaluate(at(1.0)).wrench.norm(), 0.0);
  EXPECT_NEAR(line.evaluate(at(1.4)).wrench[0], -2.0, 1e-15);
}

TEST(PointSpring, ALineWithoutLengthNeverPushes) {
  const PointSpring line(
      {.stiffness = 5.0, .damping = 4.0, .tension_only = true});
  EXPECT_EQ(line.evaluate(at(0.2, -1.0)).wrench.norm(), 0.0);
  EXPECT_NEAR(line.evaluate(at(0.2, 1.0)).wrench[0], -5.0, 1e-15);
}

// The report's connection, f = -K x^2.
TEST(PointSpring, QuadraticPullsWithTheSquareOfItsExtension) {
  const PointSpring spring({.free_length = 0.5, .quadratic = 12.0});
  EXPECT_NEAR(spring.evaluate(at(2.0)).wrench[0], -27.0, 1e-13);
  EXPECT_NEAR(spring.evaluate(at(2.0)).energy, 4.0 * 3.375, 1e-13);
  EXPECT_NEAR(spring.evaluate(at(0.25)).wrench[0], 0.75, 1e-14);
}

}  // namespace
}  // namespace limber::joints::point_spring_test
