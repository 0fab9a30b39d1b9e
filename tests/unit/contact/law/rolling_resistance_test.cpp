// SPDX-License-Identifier: BSD-3-Clause
#include "limber/contact/law/rolling_resistance.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace limber::contact::rolling_resistance_test {
namespace {

using Vector2 = Eigen::Vector2d;

constexpr double kArm = 2e-3;
const RollingLoad kLoad{
    .force = 50.0, .stiffness = 1e6, .inverse_inertia = 1e3};

TEST(RollingResistance, IsTheNormalForceTimesItsArmWhereItRolls) {
  const Vector2 way(0.3, -0.4);
  const RollingResponse out =
      resist_rolling(kArm, {}, kLoad, {.rotation = way, .rate = 10.0 * way});
  EXPECT_NEAR((out.moment + kArm * 50.0 * way.normalized()).norm(), 0.0, 1e-12);
}

TEST(RollingResistance, IsAStripOfSpringsWhileItHolds) {
  const Vector2 way(1e-4, 2e-4);
  const RollingResponse out =
      resist_rolling(kArm, {}, kLoad, {.rotation = way});
  // A strip 2 a wide has the stiffness k a^2 / 3 and lifts off at N a / 3.
  const double a = 3.0 * kArm;
  EXPECT_NEAR((out.moment + 1e6 * a * a / 3.0 * way).norm(), 0.0, 1e-12);
}

TEST(RollingResistance, IsNothingWithoutALoadOrAnArm) {
  const RollingMotion motion{.rotation = {0.1, 0.2}, .rate = {1.0, 0.0}};
  const RollingSpring spring{12.0, {0.01, 0.0}};
  for (const double arm : {0.0, kArm}) {
    const RollingLoad load{.force = arm > 0.0 ? 0.0 : 50.0, .stiffness = 1e6};
    const RollingResponse out = resist_rolling(arm, spring, load, motion);
    EXPECT_EQ(out.moment, Vector2(Vector2::Zero()));
    EXPECT_EQ(out.next.stiffness, 0.0);
    EXPECT_DOUBLE_EQ(out.slip_work, find_energy(spring));
  }
}

// Work on the bodies over an increment that ends with this moment is no more
// than the spring gives up.
TEST(RollingResistance, NeverAddsEnergyWhateverTheLoadDoes) {
  RollingSpring spring;
  Vector2 rotation(1e-4, 0.0);
  for (int i = 0; i < 400; ++i) {
    const RollingLoad load{.force = 50.0 + 49.0 * ((i * 7) % 13 - 6) / 6.0,
                           .stiffness = 1e6 * (1.0 + 0.5 * ((i * 5) % 7))};
    rotation = Vector2(rotation.x() * 0.9 - 0.5 * rotation.y(),
                       rotation.y() * 0.9 + 0.5 * rotation.x());
    const RollingResponse out =
        resist_rolling(kArm, spring, load, {.rotation = rotation});
    const double work = out.moment.dot(rotation);
    EXPECT_LE(work + out.energy - find_energy(spring), 1e-15);
    EXPECT_GE(out.slip_work, -1e-15);
    spring = out.next;
  }
}

TEST(RollingResistance, HasTheTangentsOfItsMoment) {
  const RollingSpring before{11.0, {0.02, -0.03}};
  const std::vector<RollingMotion> motions = {
      {.rotation = {1e-3, 2e-3}, .rate = {0.01, 0.02}},
      {.rotation = {3e-2, -2e-2}, .rate = {1.0, -0.5}},
      {.rotation = {1e-3, 2e-3}, .rate = {3.0, 1.0}}};
  for (const RollingMotion& motion : motions) {
    const auto moment = [&](const Vector2& rotation, const Vector2& rate,
                            double f) {
      RollingLoad load = kLoad;
      load.force = f;
      return resist_rolling(kArm, before, load, {rotation, rate}).moment;
    };
    const RollingResponse out = resist_rolling(kArm, before, kLoad, motion);
    const double h = 1e-7;
    for (int i = 0; i < 2; ++i) {
      const Vector2 e = h * Vector2::Unit(i);
      const Vector2 by_rotation =
          (moment(motion.rotation + e, motion.rate, 50.0) -
           moment(motion.rotation - e, motion.rate, 50.0)) /
          (2.0 * h);
      const Vector2 by_rate = (moment(motion.rotation, motion.rate + e, 50.0) -
                               moment(motion.rotation, motion.rate - e, 50.0)) /
                              (2.0 * h);
      EXPECT_LT((out.by_rotation.col(i) - by_rotation).norm(), 1e-5);
      EXPECT_LT((out.by_rate.col(i) - by_rate).norm(), 1e-5);
    }
    const Vector2 by_force =
        (moment(motion.rotation, motion.rate, 50.0 + 1e-4) -
         moment(motion.rotation, motion.rate, 50.0 - 1e-4)) /
        2e-4;
    EXPECT_LT((out.by_force - by_force).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace limber::contact::rolling_resistance_test
