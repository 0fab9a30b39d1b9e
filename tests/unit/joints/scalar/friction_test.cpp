// SPDX-License-Identifier: BSD-3-Clause
#include "limber/joints/scalar/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/differences.hpp"

namespace limber::joints::friction_test {
namespace {

// m v' = F + friction, by fourth-order Runge-Kutta, until it is steady.
double find_creep(const Friction& friction, double push) {
  const auto rate = [&](double v) {
    return push + friction.evaluate({0.0, v}).force;
  };
  double v = 0.0;
  constexpr double kStep = 1e-4;
  for (int i = 0; i < 20000; ++i) {
    const double a = rate(v);
    const double b = rate(v + 0.5 * kStep * a);
    const double c = rate(v + 0.5 * kStep * b);
    const double d = rate(v + kStep * c);
    v += kStep / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return v;
}

TEST(Friction, BelowCoulombsForceItCreepsWithTheClosedForm) {
  testing::Margin margin;
  for (const double speed : {1e-3, 5e-3}) {
    const Friction friction({.coulomb = 2.0, .speed = speed});
    for (const double push : {-1.9, 0.2, 1.0}) {
      const double creep = speed * push / std::sqrt(4.0 - push * push);
      margin.add(std::abs(find_creep(friction, push) / creep - 1.0), 1.0);
    }
  }
  margin.expect_below(1e-9);
}

TEST(Friction, FastMotionMeetsCoulombsForceAndTheViscousOne) {
  const Friction friction({.coulomb = 2.0, .viscous = 0.3, .speed = 1e-3});
  const ScalarResponse at = friction.evaluate({0.0, -5.0});
  // 1 / sqrt(1 + (vs / v)^2) = 1 - 2e-8
  EXPECT_NEAR(at.force, 2.0 * (1.0 - 2e-8) + 1.5, 1e-14);
  EXPECT_NEAR(at.dissipation, 5.0 * at.force, 1e-14);
}

TEST(Friction, ItsDampingAtRestIsCoulombsForceByTheSmoothingSpeed) {
  const Friction friction({.coulomb = 2.0, .viscous = 0.3, .speed = 1e-3});
  EXPECT_NEAR(friction.evaluate({}).damping, 2000.3, 1e-10);
}

}  // namespace
}  // namespace limber::joints::friction_test
