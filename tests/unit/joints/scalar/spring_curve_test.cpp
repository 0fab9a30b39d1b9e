// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/spring_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "limber/joints/scalar/scalar_spring.hpp"

namespace limber::joints::spring_curve_test {
namespace {

constexpr double kRoundoff = 1e-14;  // relative

TEST(SpringCurve, LinearEnergyIsHalfKSSquared) {
  const SpringCurve curve({.stiffness = 40.0});
  const SpringCurve::Point at = curve.evaluate(-0.3);
  EXPECT_DOUBLE_EQ(at.force, -12.0);
  EXPECT_DOUBLE_EQ(at.energy, 1.8);
  EXPECT_DOUBLE_EQ(at.slope, 40.0);
}

// f = -K x^2 of the report, and its energy K |x|^3 / 3.
TEST(SpringCurve, QuadraticEnergyIsAThirdOfTheCube) {
  const SpringCurve curve({.quadratic = 60.0});
  for (const double s : {-1.5, -0.2, 0.0, 0.4, 2.0}) {
    const SpringCurve::Point at = curve.evaluate(s);
    EXPECT_NEAR(at.force, 60.0 * s * std::abs(s), kRoundoff * 240.0);
    EXPECT_NEAR(at.energy, 20.0 * std::abs(s * s * s), kRoundoff * 160.0);
    EXPECT_NEAR(at.slope, 120.0 * std::abs(s), kRoundoff * 240.0);
  }
}

// Areas of trapezia, by hand.
TEST(SpringCurve, TabulatedEnergyIsTheAreaUnderTheTable) {
  const SpringCurve curve(
      {.extensions = {-1.0, 1.0, 2.0}, .forces = {-10.0, 10.0, 40.0}});
  EXPECT_NEAR(curve.evaluate(0.0).energy, 0.0, kRoundoff);
  EXPECT_NEAR(curve.evaluate(1.0).energy, 5.0, kRoundoff * 5.0);
  EXPECT_NEAR(curve.evaluate(2.0).energy, 30.0, kRoundoff * 30.0);
  EXPECT_NEAR(curve.evaluate(-1.0).energy, 5.0, kRoundoff * 5.0);
  // Outside: on with the slopes 30 and 10 of the ends.
  EXPECT_NEAR(curve.evaluate(3.0).force, 70.0, kRoundoff * 70.0);
  EXPECT_NEAR(curve.evaluate(3.0).energy, 85.0, kRoundoff * 85.0);
  EXPECT_NEAR(curve.evaluate(-3.0).force, -30.0, kRoundoff * 30.0);
  EXPECT_NEAR(curve.evaluate(-3.0).energy, 45.0, kRoundoff * 45.0);
}

TEST(SpringCurve, ATableOnOneSideOfRestStoresNothingAtRest) {
  const SpringCurve curve({.extensions = {1.0, 3.0}, .forces = {5.0, 9.0}});
  EXPECT_NEAR(curve.evaluate(0.0).force, 3.0, kRoundoff * 3.0);
  EXPECT_NEAR(curve.evaluate(0.0).energy, 0.0, kRoundoff);
  EXPECT_NEAR(curve.evaluate(3.0).energy, 18.0, kRoundoff * 18.0);
}

TEST(SpringCurve, ALinearTableIsALinearSpring) {
  const SpringCurve line({.stiffness = 7.0});
  const SpringCurve table({.extensions = {-2.0, -0.5, 1.0, 4.0},
                           .forces = {-14.0, -3.5, 7.0, 28.0}});
  for (double s = -5.0; s < 6.0; s += 0.7) {
    EXPECT_NEAR(table.evaluate(s).force, line.evaluate(s).force, 1e-13);
    EXPECT_NEAR(table.evaluate(s).energy, line.evaluate(s).energy, 1e-12);
    EXPECT_NEAR(table.evaluate(s).slope, 7.0, 1e-14);
  }
}

TEST(SpringCurve, CoefficientsAndTableAddUp) {
  const SpringCurve both({.stiffness = 2.0,
                          .quadratic = 3.0,
                          .extensions = {0.0, 1.0},
                          .forces = {0.0, 4.0}});
  const SpringCurve::Point at = both.evaluate(2.0);
  EXPECT_DOUBLE_EQ(at.force, 4.0 + 12.0 + 8.0);
  EXPECT_DOUBLE_EQ(at.energy, 4.0 + 8.0 + 8.0);
  EXPECT_DOUBLE_EQ(at.slope, 2.0 + 12.0 + 4.0);
}

ScalarSpring line() {
  return ScalarSpring({.curve = SpringCurve({.stiffness = 100.0}),
                       .damping = 8.0,
                       .rest = 1.0,
                       .tension_only = true});
}

TEST(ScalarSpring, ASlackLineNeitherPullsNorStores) {
  for (const double rate : {-3.0, 0.0, 3.0}) {
    const ScalarResponse at = line().evaluate({0.9, rate});
    EXPECT_EQ(at.force, 0.0);
    EXPECT_EQ(at.energy, 0.0);
    EXPECT_EQ(at.dissipation, 0.0);
  }
}

TEST(ScalarSpring, ALinePullsAsSoonAsItIsTaut) {
  EXPECT_NEAR(line().evaluate({1.0 + 1e-6, 0.0}).force, -1e-4, 1e-13);
}

TEST(ScalarSpring, ALineHeldTautGoesOnWhereItBecomesSlack) {
  const SwitchModes taut{SwitchMode::on, SwitchMode::off};
  for (const double s : {-1e-3, 1e-3}) {
    const ScalarResponse at = line().evaluate({1.0 + s, 0.5}, taut);
    EXPECT_NEAR(at.force, -4.0 - 100.0 * s, 1e-12);
    EXPECT_EQ(at.stiffness, 100.0);
  }
}

// At s = 0.1 the spring's 10 N are used up by the damper at 1.25 m/s.
TEST(ScalarSpring, ALineThatIsLetGoFastDoesNotPush) {
  EXPECT_NEAR(line().evaluate({1.1, -1.0}).force, -2.0, 10.0 * kRoundoff);
  const ScalarResponse at = line().evaluate({1.1, -2.0});
  EXPECT_EQ(at.force, 0.0);
  EXPECT_NEAR(at.energy, 0.5, kRoundoff);
  EXPECT_NEAR(at.dissipation, 20.0, kRoundoff * 20.0);
}

}  // namespace
}  // namespace limber::joints::spring_curve_test
